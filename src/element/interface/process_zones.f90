!> The zones in which interfaces soften, and how finely a mesh resolves them.
module plydyn_element_interface_process_zones
   use plydyn_base_precision, only : wp
   use plydyn_element_quad, only : quad_spacing, tensor_order
   use plydyn_law_cohesive_process_zone_length, only : strength_factor, zone_lengths
   use plydyn_model_layup, only : faces_tied, part_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: new_process_zone

   !> What surrounds the interfaces of one material; the worst of all of them
   type, public :: process_zone_type
      !> Lengths of the zones of opening and of sliding, with the strengths below
      real(wp) :: length(2) = huge(1.0_wp)
      !> Largest distance between neighbouring nodes in the plane
      real(wp) :: spacing = 0.0_wp
      !> Smallest modulus across an interface, and thickness of the thinnest stack beside one
      real(wp) :: across = huge(1.0_wp), thickness = huge(1.0_wp)
      !> Strengths of opening and of sliding, fitted to the mesh where the deck asks for it
      real(wp) :: strength(2) = 0.0_wp
      !> Interfaces of the material in all parts
      integer :: interfaces = 0
   end type process_zone_type

contains

   !> Look at all interfaces of a material that fails
   pure function new_process_zone(model, material) result(zone)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the interface material
      integer, intent(in) :: material
      type(process_zone_type) :: zone

      integer :: k, p

      associate (own => model%interface_materials(material))
         do p = 1, size(model%parts)
            do k = 1, size(model%parts(p)%joint)
               if (model%parts(p)%joint(k) /= material) cycle
               zone%interfaces = zone%interfaces + 1
               zone%across = min(zone%across, across(model, p, k))
               zone%thickness = min(zone%thickness, thinner(model%parts(p), k))
               zone%spacing = max(zone%spacing, node_spacing(model%mesh, p))
            end do
         end do
         zone%strength(:) = own%constants%strength
         if (own%fitted) zone%strength(:) = zone%strength*strength_factor(zone%across, &
            & own%constants%toughness, zone%strength, zone%spacing)
         do p = 1, size(model%parts)
            do k = 1, size(model%parts(p)%joint)
               if (model%parts(p)%joint(k) /= material) cycle
               zone%length(:) = min(zone%length, zone_lengths(across(model, p, k), &
                  & along(model, p, k), thinner(model%parts(p), k), own%constants%toughness, &
                  & zone%strength))
            end do
         end do
      end associate
   end function new_process_zone

   !> Smaller modulus across of the plies at an interface
   pure real(wp) function across(model, p, k)
      type(model_type), intent(in) :: model
      !> Part, and interface in it
      integer, intent(in) :: p, k

      associate (plies => model%parts(p)%plies)
         across = min(model%materials(plies(k)%material)%law%young(3), &
            & model%materials(plies(k + 1)%material)%law%young(3))
      end associate
   end function across

   !> Smaller modulus along the fibres of the plies at an interface
   pure real(wp) function along(model, p, k)
      type(model_type), intent(in) :: model
      !> Part, and interface in it
      integer, intent(in) :: p, k

      associate (plies => model%parts(p)%plies)
         along = min(model%materials(plies(k)%material)%law%young(1), &
            & model%materials(plies(k + 1)%material)%law%young(1))
      end associate
   end function along

   !> Thickness of the thinner of the tied stacks at an interface
   pure real(wp) function thinner(part, k) result(thickness)
      type(part_type), intent(in) :: part
      !> The interface
      integer, intent(in) :: k

      integer :: first, last

      first = k
      do while (first > 1)
         if (part%joint(first - 1) /= faces_tied) exit
         first = first - 1
      end do
      last = k + 1
      do while (last < size(part%plies))
         if (part%joint(last) /= faces_tied) exit
         last = last + 1
      end do
      thickness = min(sum(part%plies(first:k)%thickness), sum(part%plies(k + 1:last)%thickness))
   end function thinner

   !> Largest distance between neighbouring nodes of the quads of a part
   pure real(wp) function node_spacing(mesh, part) result(spacing)
      type(mesh_type), intent(in) :: mesh
      !> Index of the part
      integer, intent(in) :: part

      integer :: e, side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      spacing = 0.0_wp
      do e = 1, size(mesh%quad_part)
         if (mesh%quad_part(e) /= part) cycle
         spacing = max(spacing, quad_spacing(side, &
            & mesh%position(1:2, mesh%quad_node(tensor_order(side), e))))
      end do
   end function node_spacing

end module plydyn_element_interface_process_zones
