!> The list of all keywords, in the order of the manual.
!>
!> A new keyword is a routine that visits its fields, and its row in the list of its family.
module plydyn_input_keywords
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_input_control, only : add_control
   use plydyn_input_damage, only : add_damaged_materials
   use plydyn_input_fixture, only : add_fixtures
   use plydyn_input_impactor, only : add_impactors
   use plydyn_input_interface, only : add_interfaces
   use plydyn_input_keyword_row, only : keyword_list_type, keyword_row_type
   use plydyn_input_load, only : add_loads
   use plydyn_input_material, only : add_elastic_materials
   use plydyn_input_mesh, only : add_mesh
   use plydyn_input_metal, only : add_metals
   use plydyn_input_output, only : add_output
   use plydyn_input_part, only : add_parts
   use plydyn_input_solid, only : add_solids
   use plydyn_input_support, only : add_supports
   use plydyn_input_unsupported_keywords, only : ignored_keywords, refused_keywords
   implicit none
   private

   public :: all_keywords, all_rows

contains

   !> Rows of all keywords, in the order of the manual
   function all_rows() result(rows)
      type(keyword_row_type), allocatable :: rows(:)

      type(keyword_list_type) :: list

      call add_control(list)
      call add_mesh(list)
      call add_parts(list)
      call add_elastic_materials(list)
      call add_metals(list)
      call add_damaged_materials(list)
      call add_solids(list)
      call add_interfaces(list)
      call add_supports(list)
      call add_loads(list)
      call add_impactors(list)
      call add_fixtures(list)
      call add_output(list)
      call list%add_unread(ignored_keywords())
      call list%add_unread(refused_keywords())
      rows = list%rows(:list%count)
   end function all_rows

   !> Declarations of all keywords
   function all_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      type(keyword_row_type), allocatable :: rows(:)

      rows = all_rows()
      keywords = rows%declaration
   end function all_keywords

end module plydyn_input_keywords
