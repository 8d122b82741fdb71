!> Inertia that locally implicit operators add, for the largest step of the run.
module plydyn_domain_build_inertia
   use plydyn_base_precision, only : wp
   use plydyn_domain_build_columns, only : column_links, is_held, new_column_inertia
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type, face_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_pair_inertia, only : inertia_links_type, joint_stiffness, new_pair_inertia
   use plydyn_element_quad, only : quad_node_area, tensor_order
   use plydyn_model_control, only : all_explicit, implicit_interfaces, implicit_thickness
   use plydyn_model_mesh, only : mesh_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_inertia, couple_surface, largest_step

contains

   !> The share of the stable step that the deck allows, within its bounds
   pure real(wp) function largest_step(domain) result(step)
      type(domain_type), intent(in) :: domain

      associate (control => domain%control)
         step = control%step_share()*domain%limit%step
         if (control%largest_step > 0.0_wp) step = min(step, control%largest_step)
         if (control%step_curve > 0) step = min(step, maxval(domain%curves(control%step_curve)%y))
      end associate
   end function largest_step

   !> All that the scheme of the deck adds
   subroutine build_inertia(model, division, numbering, domain)
      type(model_type), intent(in) :: model
      !> All quads
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> The domain; its supports, joints and step are known
      type(domain_type), intent(inout) :: domain

      real(wp) :: joint(3, size(domain%layers%joint))
      real(wp), allocatable :: area(:, :)

      allocate (domain%inertia%moved_links%place(2, 0), domain%inertia%moved_links%inertia(0))
      allocate (domain%inertia%held_links%place(2, 0), domain%inertia%held_links%inertia(0))
      if (domain%control%scheme /= all_explicit) then
         joint(:, :) = joint_stiffness(domain%groups, size(joint, 2))
         area = node_areas(model%mesh, division, numbering)
         domain%inertia%pairs = new_pair_inertia(domain%comm, numbering%here, domain%columns, &
            & domain%inertia%mass, &
            & sum(area, 2), joint, domain%step)
      end if
      if (domain%control%scheme == implicit_interfaces) then
         domain%inertia%moved_links = domain%inertia%pairs%links_between(domain%columns, &
            & is_moved(domain))
      else if (domain%control%scheme == implicit_thickness) then
         ! columns take the pairs with them
         domain%inertia%pairs%active = .false.
         domain%inertia%thickness = new_column_inertia(domain, numbering%here, area, joint)
         domain%inertia%moved_links = column_links(domain, area, joint, is_moved(domain), &
            & is_moved(domain))
         domain%inertia%held_links = held_links(domain, area, joint)
      end if
      associate (moved => domain%inertia%moved_links, held => domain%inertia%held_links)
         moved%own = numbering%own(domain%columns%column_of(moved%place(1, :)))
         held%own = numbering%own(domain%columns%column_of(held%place(2, :)))
      end associate
   end subroutine build_inertia

   !> Area that belongs to each node in each part, by quadrature at the nodes, (nodes, parts)
   pure function node_areas(mesh, division, numbering) result(area)
      type(mesh_type), intent(in) :: mesh
      !> Its quads, those of other ranks too: they add to nodes where ranks meet
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      real(wp), allocatable :: area(:, :)

      real(wp) :: all(size(mesh%quad_node, 1))
      integer :: e, here(size(mesh%quad_node, 1)), i, node(size(mesh%quad_node, 1)), p, side

      side = nint(sqrt(real(size(mesh%quad_node, 1), wp)))
      allocate (area(size(numbering%here), size(division%parts)), source=0.0_wp)
      do p = 1, size(division%parts)
         associate (quads => division%parts(p)%element)
            do e = 1, size(quads)
               node(:) = mesh%quad_node(tensor_order(side), quads(e))
               here(:) = numbering%node(node)
               if (.not. any(here > 0)) cycle
               all(:) = quad_node_area(side, mesh%position(1:2, node))
               do i = 1, size(all)
                  if (here(i) > 0) area(here(i), p) = area(here(i), p) + all(i)
               end do
            end do
         end associate
      end do
   end function node_areas

   !> Added inertia between held points, as places in their list, and those of their columns that
   !> are free
   pure function held_links(domain, area, joint) result(links)
      type(domain_type), intent(in) :: domain
      !> As in `column_links`
      real(wp), intent(in) :: area(:, :), joint(:, :)
      type(inertia_links_type) :: links

      integer :: i, number(domain%columns%freedoms)

      links = column_links(domain, area, joint, is_held(domain), .not. is_held(domain))
      number(domain%supports%held) = [(i, i=1, size(domain%supports%held))]
      links%place(1, :) = number(links%place(1, :))
   end function held_links

   !> Whether each place in the arrays of motion has a prescribed motion
   pure function is_moved(domain) result(moved)
      type(domain_type), intent(in) :: domain
      logical :: moved(domain%columns%freedoms)
      integer :: m

      moved(:) = .false.
      do m = 1, size(domain%supports%motions)
         moved(domain%supports%motions(m)%freedom) = .true.
      end do
   end function is_moved

   !> Inverse masses of the points of a face that take their columns with them
   pure subroutine couple_surface(domain, face, surface, inverse_mass)
      type(domain_type), intent(in) :: domain
      !> Layer and thickness node of the face
      integer, intent(in) :: face(2)
      type(face_type), intent(inout) :: surface
      !> Inverse mass of its points along x, y, z; changes where the rank has them
      real(wp), intent(inout) :: inverse_mass(:, :)

      integer :: c, freedom, i

      if (.not. domain%inertia%thickness%active) return
      associate (columns => domain%inertia%thickness)
         freedom = columns%freedom(columns%row_of(domain%columns, face(1), face(2)))
         surface%follow = columns%followers(freedom)
         do i = 1, size(surface%here)
            do c = 1, 3
               associate (k => surface%here(i))
                  inverse_mass(c, k) = inverse_mass(c, k) &
                     & *columns%own_response(freedom, columns%kind(c, surface%node(k)))
               end associate
            end do
         end do
      end associate
   end subroutine couple_surface

end module plydyn_domain_build_inertia
