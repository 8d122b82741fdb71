!> Forces on the points: F_ext - F_int of the paper's eq. 6.
module plydyn_solver_forces
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_interface_kernel, only : add_face_forces
   use plydyn_element_plate, only : add_layer_forces
   use plydyn_model_control, only : total_lagrangian
   implicit none
   private

   public :: add_interface_forces, add_loads, add_ply_forces, load_power

contains

   !> Subtract the internal forces of all plies
   subroutine add_ply_forces(domain, step, displacement, history, force)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> The step just made
      real(wp), intent(in) :: step
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: b, p

      do p = 1, size(domain%plates)
         associate (plate => domain%plates(p))
            do b = 1, size(plate%batches)
               call add_layer_forces(plate%batches(b), plate%side, plate%node, plate%metric, &
                  & domain%control%kinematics == total_lagrangian, step, &
                  & displacement(plate%batches(b)%first:), &
                  & history(plate%batches(b)%first_history:), force(plate%batches(b)%first:))
            end do
         end associate
      end do
   end subroutine add_ply_forces

   !> Subtract the internal forces of the interfaces between layers
   subroutine add_interface_forces(domain, displacement, history, force)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      !> History of all Gauss points
      real(wp), intent(inout), contiguous :: history(:)
      !> Force on all points
      real(wp), intent(inout), contiguous :: force(:)

      integer :: k

      do k = 1, size(domain%interfaces)
         call add_face_forces(domain%interfaces(k), &
            & domain%control%kinematics == total_lagrangian, displacement, &
            & history(domain%interfaces(k)%first_history:), force)
      end do
   end subroutine add_interface_forces

   !> Add the loads at some time
   subroutine add_loads(domain, time, factor, force)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Time
      real(wp), intent(in) :: time
      !> Value of each load's curve then
      real(wp), intent(out) :: factor(:)
      !> Force on all points
      real(wp), intent(inout) :: force(:)

      integer :: i, k

      do k = 1, size(domain%loads)
         associate (load => domain%loads(k))
            factor(k) = domain%curves(load%curve)%at(time)
            do i = 1, size(load%freedom)
               force(load%freedom(i)) = force(load%freedom(i)) + factor(k)*load%force(i)
            end do
         end associate
      end do
   end subroutine add_loads

   !> Power of the loads
   pure real(wp) function load_power(domain, factor, velocity) result(power)
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Value of each load's curve
      real(wp), intent(in) :: factor(:)
      !> Velocity of all points
      real(wp), intent(in) :: velocity(:)

      real(wp) :: sum
      integer :: i, k

      power = 0.0_wp
      do k = 1, size(domain%loads)
         associate (load => domain%loads(k))
            sum = 0.0_wp
            do i = 1, size(load%freedom)
               sum = sum + load%force(i)*velocity(load%freedom(i))
            end do
            power = power + factor(k)*sum
         end associate
      end do
   end function load_power

end module plydyn_solver_forces
