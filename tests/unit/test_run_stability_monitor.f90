!> The worst point, which is named when a run becomes unstable, and the energy of the elements: what
!> is stored and dissipated is the work of their forces.
program test_run_stability_monitor
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_method_element_balance, only : element_balance_type
   use plydyn_model_model, only : model_type
   use plydyn_run_stability_monitor, only : check_balance, check_finite, check_stability
   use plydyn_run_setup, only : new_state
   use plydyn_state_state, only : state_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, check_error, finish
   implicit none

   type(domain_type) :: domain
   type(element_balance_type) :: balance
   type(error_type), allocatable :: error
   type(model_type) :: model
   type(state_type) :: start, state

   model = rectangle_model(rectangle_mesh(3, 2, 2, 10.0_wp, 10.0_wp, 0.0_wp), &
      & [0.0_wp, 90.0_wp], 0.25_wp, [1, 1])
   model%control%end_time = 1.0_wp
   ! numbers of the user that fall where places rise: 990, 980, 970 ...
   model%mesh%node_id = 1000 - model%mesh%node_id
   call build_domain(model, domain, error)
   call new_state(model, domain, start)
   start%cycle = 3
   start%step = 1.0_wp
   start%first_step = 1.0_wp

   call begin("check_stability")
   state = start
   call check_stability(domain, model, state, error)
   call check(.not. allocated(error), "nothing is wrong")

   state = start
   state%energies%reference = 1.0_wp
   state%energies%internal = 2.0_wp
   state%velocity(domain%columns%freedom(1, 2, 3, 4)) = -5.0_wp
   state%velocity(domain%columns%freedom(2, 1, 2, 7)) = 6.0_wp
   call check_stability(domain, model, state, error)
   call check_error(error, "fastest is the motion along y at node 930, ply 2 from the " &
      & //"bottom, part 1, 6", &
      & "the fastest is named")
   state%velocity(domain%columns%freedom(1, 1, 1, 9)) = -6.0_wp
   call check_stability(domain, model, state, error)
   call check_error(error, "fastest is the motion along x at node 910, ply 1 from the " &
      & //"bottom, part 1, 6", &
      & "of two that are as fast that of the least number")

   call begin("check_finite")
   state = start
   call check_finite(domain, model, state, error)
   call check(.not. allocated(error), "nothing is wrong")
   state%energies%internal = ieee_value(1.0_wp, ieee_quiet_nan)
   state%acceleration(domain%columns%freedom(2, 2, 1, 6)) = -1.0e200_wp
   call check_finite(domain, model, state, error)
   call check_error(error, "the largest acceleration is along x at node 940, ply 2 from the " &
      & //"bottom, part 1, 1e200", "numbers whose squares overflow are named")
   state%velocity(domain%columns%freedom(1, 1, 2, 3)) = ieee_value(1.0_wp, ieee_positive_inf)
   call check_finite(domain, model, state, error)
   call check_error(error, "velocity along y at node 970, ply 1 from the bottom, part 1", &
      & "an infinite speed is named")
   state%acceleration(domain%columns%freedom(1, 2, 3, 4)) = ieee_value(1.0_wp, ieee_quiet_nan)
   state%acceleration(domain%columns%freedom(2, 2, 3, 5)) = ieee_value(1.0_wp, ieee_quiet_nan)
   call check_finite(domain, model, state, error)
   call check_error(error, "acceleration along z at node 950, ply 2 from the bottom", &
      & "of two that are no numbers that of the least number")
   state = start
   state%energies%external = ieee_value(1.0_wp, ieee_quiet_nan)
   state%energies%reference = 1.0_wp
   call check_finite(domain, model, state, error)
   call check_error(error, "no longer finite at cycle 3", "work from outside is looked at")

   call begin("check_balance")
   state = start
   balance = element_balance_type(internal=1.0_wp, stored=0.6_wp, reference=2.0_wp)
   balance%dissipated(1) = 0.4_wp
   call check_balance(domain, state, balance, error)
   call check(.not. allocated(error), "work is stored and dissipated")
   balance%stored = 0.75_wp
   call check_balance(domain, state, balance, error)
   call check_error(error, "given back more energy than they took at cycle 3, time 0: by " &
      & //"their strains and stresses they have stored 0.75, the work of their forces less " &
      & //"what they have dissipated is 0.6", "more is stored than there is")
   balance%stored = 0.45_wp
   call check_balance(domain, state, balance, error)
   call check_error(error, "have lost energy", "work is lost")
   balance%hourglass = 0.15_wp
   call check_balance(domain, state, balance, error)
   call check(.not. allocated(error), "unless hourglass control has it")
   balance%dissipated(1) = 1.2_wp
   call check_balance(domain, state, balance, error)
   call check_error(error, "have given back more energy than they took", &
      & "more is dissipated than there is")
   balance%dissipated(2) = ieee_value(1.0_wp, ieee_quiet_nan)
   call check_balance(domain, state, balance, error)
   call check_error(error, "no longer finite", "what is no number is reported")
   balance%reference = 0.0_wp
   balance%dissipated(:) = 0.0_wp
   call check_balance(domain, state, balance, error)
   call check(.not. allocated(error), "nothing is wrong where no energy goes in")
   call finish()
end program test_run_stability_monitor
