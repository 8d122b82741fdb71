!> What crack zones make of a model: doubled nodes, strengths of cracks, and plies whose matrix no
!> longer softens.
module plydyn_model_cracks
   use plydyn_base_precision, only : wp
   use plydyn_law_law, only : law_constants_type
   use plydyn_model_crack_lines, only : double_nodes, find_lattice, find_lines
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: prepare_cracks

   !> Stiffness of a crack over that of the ply between two lines: an open crack gives way, and its
   !> springs do not limit the step
   real(wp), parameter :: relative_stiffness = 10.0_wp

contains

   !> Double the nodes of all crack zones and complete their constants
   subroutine prepare_cracks(model, problem)
      !> Has its zones as the deck gives them
      type(model_type), intent(inout) :: model
      !> What is wrong with the quads or the plies of a zone, empty if nothing is
      character(:), allocatable, intent(out) :: problem

      integer :: i, z

      problem = ""
      do z = 1, size(model%crack_zones)
         associate (zone => model%crack_zones(z))
            call find_lattice(model%mesh, zone, problem)
            if (len(problem) == 0) call find_lines(model%parts(zone%part)%plies, zone, problem)
            if (len(problem) > 0) return
            call complete_plies(model, zone)
            call double_nodes(model%mesh, zone)
         end associate
      end do
      do i = 1, size(model%initial_velocities)
         associate (nodes => model%initial_velocities(i)%nodes)
            model%initial_velocities(i)%nodes = [nodes, model%mesh%twins_of(nodes)]
         end associate
      end do
   end subroutine prepare_cracks

   !> Strengths and stiffnesses of the cracks of a zone, and materials of its own for its plies
   subroutine complete_plies(model, zone)
      type(model_type), intent(inout) :: model
      type(crack_zone_type), intent(inout) :: zone

      integer :: first, p

      first = size(model%materials)
      do p = 1, size(zone%plies)
         associate (ply => zone%plies(p), own => model%parts(zone%part)%plies(p)%material)
            ply%strength(:) = model%materials(own)%law%crack_strengths()
            where (zone%strength > 0.0_wp) ply%strength = zone%strength
            ply%stiffness = zone%stiffness
            if (.not. zone%stiffness > 0.0_wp) ply%stiffness = relative_stiffness &
               & *model%materials(own)%law%young(2)/ply%pitch
            if (.not. model%materials(own)%is_damaged()) cycle
            own = cracked_material(model, own, first)
         end associate
      end do
   end subroutine complete_plies

   !> Index of the copy of a material without matrix damage
   integer function cracked_material(model, material, first) result(copy)
      type(model_type), intent(inout) :: model
      !> Index of the material, and of the last one that is no copy for the same zone
      integer, intent(in) :: material, first

      type(material_type) :: cracked
      class(law_constants_type), allocatable :: law

      do copy = first + 1, size(model%materials)
         if (model%materials(copy)%id == model%materials(material)%id) return
      end do
      cracked = model%materials(material)
      call move_alloc(cracked%law, law)
      call law%leave_cracks()
      call add_material(model%materials, cracked, law)
   end function cracked_material

end module plydyn_model_cracks
