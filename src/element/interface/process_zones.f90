!> The zones in which interfaces soften, how finely a mesh resolves them, and strengths of points.
module plydyn_element_interface_process_zones
   use plydyn_base_precision, only : wp
   use plydyn_element_quad, only : quad_spacing, tensor_order
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_cohesive_process_zone_length, only : least_points, strength_factor, zone_lengths
   use plydyn_model_layup, only : faces_tied, part_type
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: find_weakness, new_process_zone

   !> Strengths fitted to quads of one size differ by no more
   real(wp), parameter :: round_off = 1.0e-9_wp

   !> What surrounds the interfaces of one material; the worst of all of them
   type, public :: process_zone_type
      !> Lengths of the zones of opening and of sliding, with the strengths below
      real(wp) :: length(2) = huge(1.0_wp)
      !> Largest distance between neighbouring nodes of a quad, the coarsest of all
      real(wp) :: spacing = 0.0_wp
      !> Smallest modulus across an interface, and thickness of the thinnest stack beside one
      real(wp) :: across = huge(1.0_wp), thickness = huge(1.0_wp)
      !> Strengths of opening and of sliding, fitted to the coarsest quad where the deck asks for it
      real(wp) :: strength(2) = 0.0_wp
      !> The same fitted to the finest quad
      real(wp) :: highest(2) = 0.0_wp
      !> Interfaces of the material in all parts, and quads that have some
      integer :: interfaces = 0, quads = 0
      !> Quads in which the zones of opening and of sliding span too few distances between nodes
      integer :: coarse(2) = 0
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
               zone%across = min(zone%across, modulus(model, p, k, 3))
               zone%thickness = min(zone%thickness, thinner(model%parts(p), k))
               zone%spacing = max(zone%spacing, node_spacing(model%mesh, p))
            end do
         end do
         zone%strength(:) = fitted_strength(own, zone%across, zone%spacing)
         do p = 1, size(model%parts)
            do k = 1, size(model%parts(p)%joint)
               if (model%parts(p)%joint(k) /= material) cycle
               zone%length(:) = min(zone%length, zone_lengths(modulus(model, p, k, 3), &
                  & modulus(model, p, k, 1), thinner(model%parts(p), k), &
                  & own%constants%toughness, zone%strength))
            end do
         end do
         do p = 1, size(model%parts)
            if (any(model%parts(p)%joint == material)) call assess_quads(model, p, material, zone)
         end do
      end associate
   end function new_process_zone

   !> Strengths, fitted to a distance between nodes where the deck asks for it
   pure function fitted_strength(material, across, spacing) result(strength)
      !> The interface material
      type(interface_material_type), intent(in) :: material
      !> Modulus across, and the distance
      real(wp), intent(in) :: across, spacing
      real(wp) :: strength(2)

      strength(:) = material%constants%strength
      if (material%fitted) strength(:) = strength*strength_factor(across, &
         & material%constants%toughness, strength, spacing)
   end function fitted_strength

   !> Count the quads of a part that are too coarse, and find the highest strengths of all
   pure subroutine assess_quads(model, p, material, zone)
      type(model_type), intent(in) :: model
      !> Indices of the part and of the interface material
      integer, intent(in) :: p, material
      !> What surrounds its interfaces
      type(process_zone_type), intent(inout) :: zone

      real(wp) :: length(2), spacing, strength(2)
      integer :: e, k

      associate (own => model%interface_materials(material))
         do e = 1, size(model%mesh%quad_part)
            if (model%mesh%quad_part(e) /= p) cycle
            spacing = spacing_of(model%mesh, e)
            strength(:) = fitted_strength(own, zone%across, spacing)
            zone%quads = zone%quads + 1
            zone%highest(:) = max(zone%highest, strength)
            length(:) = zone%length
            do k = 1, merge(size(model%parts(p)%joint), 0, own%fitted)
               if (model%parts(p)%joint(k) == material) length(:) = min(length, &
                  & zone_lengths(modulus(model, p, k, 3), modulus(model, p, k, 1), &
                  & thinner(model%parts(p), k), own%constants%toughness, strength))
            end do
            where (length < real(least_points, wp)*spacing) zone%coarse = zone%coarse + 1
         end do
      end associate
   end subroutine assess_quads

   !> Square of the strength of a law over that of each point of some quads, where strengths are
   !> fitted to the mesh or scatter, (lanes, points, quads); none where all are as the law's, the
   !> one fitted to the coarsest quad
   pure subroutine find_weakness(model, material, quads, interfaces, weakness)
      !> The model
      type(model_type), intent(in) :: model
      !> Index of the interface material, and quads of the mesh
      integer, intent(in) :: material, quads(:)
      !> Interface of each lane from the bottom up; 0 for none
      integer, intent(in) :: interfaces(:)
      real(wp), allocatable, intent(out) :: weakness(:, :, :)

      type(process_zone_type) :: zone
      real(wp) :: place(2, size(model%mesh%quad_node, 1)), strength(2)
      integer :: e, l, q

      allocate (weakness(size(interfaces), size(place, 2), size(quads)), source=1.0_wp)
      zone = new_process_zone(model, material)
      associate (own => model%interface_materials(material))
         do e = 1, size(quads)
            strength(:) = fitted_strength(own, zone%across, spacing_of(model%mesh, quads(e)))
            weakness(:, :, e) = (zone%strength(1)/strength(1))**2
            if (.not. own%scatter%modulus > 0.0_wp) cycle
            place(:, :) = quad_points(model%mesh%position(:2, model%mesh%quad_node(:, quads(e))), &
               & own%nodal)
            do q = 1, size(place, 2)
               do l = 1, size(interfaces)
                  if (interfaces(l) > 0) weakness(l, q, e) = weakness(l, q, e) &
                     & /own%scatter%factor(place(:, q), interfaces(l))**2
               end do
            end do
         end do
      end associate
      if (all(abs(weakness - 1.0_wp) < round_off)) deallocate (weakness)
   end subroutine find_weakness

   !> Largest distance between neighbouring nodes of a quad
   pure real(wp) function spacing_of(mesh, quad)
      type(mesh_type), intent(in) :: mesh
      !> Index of the quad
      integer, intent(in) :: quad

      integer :: side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      spacing_of = quad_spacing(side, mesh%position(1:2, mesh%quad_node(tensor_order(side), quad)))
   end function spacing_of

   !> Smaller modulus of the plies at an interface
   pure real(wp) function modulus(model, p, k, axis)
      type(model_type), intent(in) :: model
      !> Part, interface in it, and axis: 1 along the fibres, 3 across the ply
      integer, intent(in) :: p, k, axis

      associate (plies => model%parts(p)%plies)
         modulus = min(model%materials(plies(k)%material)%law%young(axis), &
            & model%materials(plies(k + 1)%material)%law%young(axis))
      end associate
   end function modulus

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

      integer :: e

      spacing = 0.0_wp
      do e = 1, size(mesh%quad_part)
         if (mesh%quad_part(e) == part) spacing = max(spacing, spacing_of(mesh, e))
      end do
   end function node_spacing

end module plydyn_element_interface_process_zones
