!> Damage, mix of modes and lost energy at the points of an interface.
module plydyn_io_vtkhdf_interface_values
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface_interfaces, only : history_size, interface_type
   use plydyn_element_interface_group, only : interface_group_type
   use plydyn_element_interface_axes, only : find_axes, rotate_in
   use plydyn_element_quad, only : quad_node_metric
   use plydyn_law_cohesive_softening, only : closing_at, damage_at, fracture_at, friction_at, &
      & normal, share_at, shear
   use plydyn_model_control, only : total_lagrangian
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: interface_values

   !> The values, in this order: damage, share of shear in the elastic energy of the opening of this
   !> time, energy lost per area, share of the toughness that is spent
   integer, parameter, public :: at_damage = 1, at_mixity = 2, at_dissipated = 3, at_share = 4
   !> How many they are
   integer, parameter, public :: damage_values = 4

contains

   !> Values at the points of a quad in tensor order, the mix of modes at the nodes,
   !> (values, side**2)
   function interface_values(domain, state, place) result(values)
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> Group, lane and quad
      integer, intent(in) :: place(3)
      real(wp), allocatable :: values(:, :)

      select type (group => domain%groups(place(1))%item)
      type is (interface_group_type)
         allocate (values(damage_values, group%batch%side**2), source=0.0_wp)
         call find_mixity(domain, group%batch, place, state%displacement, values(at_mixity, :))
         if (group%batch%law%histories == 0) return
         associate (first => group%batch%first_history)
            call find_losses(group%batch, place, &
               & state%history(first:first - 1 + history_size(group%batch)), values)
         end associate
      end select
   end function interface_values

   !> Damage and energy from the history
   subroutine find_losses(batch, place, history, values)
      type(interface_type), intent(in) :: batch
      integer, intent(in) :: place(3)
      !> History of the batch
      real(wp), intent(in) :: history(lanes, size(batch%node, 1), size(batch%node, 2), &
         & batch%law%histories)
      real(wp), intent(inout) :: values(:, :)

      associate (h => history(place(2), :, place(3), :))
         values(at_damage, :) = h(:, damage_at)
         values(at_dissipated, :) = h(:, fracture_at)
         values(at_share, :) = h(:, share_at)
         if (size(h, 2) < closing_at) return
         values(at_dissipated, :) = values(at_dissipated, :) + h(:, closing_at)
         if (size(h, 2) < friction_at) return
         values(at_dissipated, :) = values(at_dissipated, :) + h(:, friction_at)
      end associate
   end subroutine find_losses

   !> Share of shear at the nodes; 0 where the faces do not move apart
   subroutine find_mixity(domain, batch, place, displacement, mixity)
      type(domain_type), intent(in) :: domain
      type(interface_type), intent(in) :: batch
      integer, intent(in) :: place(3)
      !> Displacement of all points
      real(wp), intent(in) :: displacement(:)
      !> Share at each node, (side**2)
      real(wp), intent(out) :: mixity(:)

      real(wp), dimension(lanes, 3, size(mixity)) :: jump, stretch, middle
      real(wp) :: above, axes(lanes, 3, 3, size(mixity)), below, opening, sliding
      integer :: c, q

      associate (columns => domain%columns, lower => batch%lower(place(2)), &
         & node => batch%node(:, place(3)), stiffness => batch%law%stiffness)
         do q = 1, size(node)
            do c = 1, 3
               below = displacement(columns%freedom(lower, columns%levels(lower), c, node(q)))
               above = displacement(columns%freedom(lower + 1, 1, c, node(q)))
               jump(:, c, q) = above - below
               middle(:, c, q) = above + below
            end do
         end do
         if (domain%control%kinematics == total_lagrangian) then
            call find_axes(batch%side, quad_node_metric(batch%side, &
               & domain%position(1:2, node)), middle, axes, stretch)
            call rotate_in(size(node), axes, jump)
         end if
         do q = 1, size(node)
            opening = stiffness(normal)*max(jump(1, 3, q), 0.0_wp)**2
            sliding = stiffness(shear)*sum(jump(1, 1:2, q)**2)
            mixity(q) = sliding/max(opening + sliding, tiny(1.0_wp))
         end do
      end associate
   end subroutine find_mixity

end module plydyn_io_vtkhdf_interface_values
