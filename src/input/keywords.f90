!> All keywords.
module plydyn_input_keywords
   use plydyn_deck_declaration, only : keyword_type
   use plydyn_input_declare_control, only : control_keywords, frame_keywords
   use plydyn_input_declare_damage, only : damage_keywords
   use plydyn_input_declare_impact, only : impact_keywords, output_keywords
   use plydyn_input_declare_interface, only : interface_keywords
   use plydyn_input_unsupported_keywords, only : ignored_keywords, refused_keywords
   use plydyn_input_declare_load, only : load_keywords, support_keywords
   use plydyn_input_declare_mesh, only : mesh_keywords
   use plydyn_input_declare_metal, only : metal_keywords
   use plydyn_input_declare_part, only : part_keywords
   use plydyn_input_declare_restart, only : restart_keywords
   use plydyn_input_declare_solid, only : solid_keywords
   implicit none
   private

   public :: all_keywords

contains

   !> Declarations of all keywords, in the order of the manual
   function all_keywords() result(keywords)
      type(keyword_type), allocatable :: keywords(:)

      keywords = [frame_keywords(), control_keywords(), mesh_keywords(), part_keywords(), &
         & metal_keywords(), damage_keywords(), solid_keywords(), interface_keywords(), &
         & support_keywords(), load_keywords(), impact_keywords(), output_keywords(), &
         & restart_keywords(), ignored_keywords(), refused_keywords()]
   end function all_keywords

end module plydyn_input_keywords
