!> The state at time zero.
module plydyn_run_initial_state
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_initial_history, only : set_initial_damage, start_histories
   use plydyn_model_model, only : model_type
   use plydyn_method_constraints, only : begin_constraints
   use plydyn_method_supports, only : support_points
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: new_state

contains

   !> Points and impactors where they begin, with the velocity that the deck gives them
   function new_state(model, domain) result(state)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(state_type) :: state

      integer :: i

      state%end%time = domain%control%end_time
      state%end%cycle = domain%control%end_cycle
      associate (n => domain%columns%freedoms)
         allocate (state%displacement(n), state%velocity(n))
      end associate
      allocate (state%acceleration(domain%columns%forces))
      state%displacement(:) = 0.0_wp
      state%velocity(:) = 0.0_wp
      state%acceleration(:) = 0.0_wp
      allocate (state%history(domain%histories + domain%averaging%halo_strains))
      state%history(:) = 0.0_wp
      call start_histories(domain, state%history)
      call set_initial_damage(model, domain, state%history)
      allocate (state%supports%load_factor(size(domain%loads)))
      allocate (state%supports%force(support_points(domain)))
      state%supports%load_factor(:) = 0.0_wp
      state%supports%force(:) = 0.0_wp
      call set_velocities(domain, state%velocity)
      allocate (state%supports%velocity(0))
      do i = 1, size(domain%supports%motions)
         state%supports%velocity = [state%supports%velocity, &
            & state%velocity(domain%supports%motions(i)%freedom)]
      end do
      call begin_constraints(domain, state%velocity, state%supports%constraints)
      allocate (state%fixtures(size(domain%contact%fixtures)))
      state%fixtures(:)%id = domain%contact%fixtures(:)%id
      state%fixtures(:)%height = domain%contact%fixtures(:)%height
      allocate (state%contacts(size(domain%contact%contacts)))
      allocate (state%impactors(size(domain%contact%impactors)))
      state%impactors(:)%id = domain%contact%impactors(:)%id
      do i = 1, size(domain%contact%impactors)
         state%impactors(i)%centre(:) = domain%contact%impactors(i)%centre
         state%impactors(i)%velocity(:) = domain%contact%impactors(i)%velocity
      end do
   end function new_state

   !> Initial velocities of whole columns; held points keep still
   subroutine set_velocities(domain, velocity)
      type(domain_type), intent(in) :: domain
      real(wp), intent(inout) :: velocity(:)

      integer :: i, k, t

      do i = 1, size(domain%supports%initial_velocities)
         associate (initial => domain%supports%initial_velocities(i))
            do k = 1, size(domain%columns%layer_slot, 2)
               do t = 1, domain%columns%levels(k)
                  velocity(domain%columns%freedom(k, t, 1, initial%nodes)) = initial%velocity(1)
                  velocity(domain%columns%freedom(k, t, 2, initial%nodes)) = initial%velocity(2)
                  velocity(domain%columns%freedom(k, t, 3, initial%nodes)) = initial%velocity(3)
               end do
            end do
         end associate
      end do
      velocity(domain%supports%held) = 0.0_wp
   end subroutine set_velocities

end module plydyn_run_initial_state
