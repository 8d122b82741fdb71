!> A family that the solver does not know: masses, stable step, forces, histories and energies of
!> bars, asked for through the same interface as those of plates, bricks and interfaces.
program test_element_group
   use bars, only : bar_group_type
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_build_elements, only : build_elements, build_masses, invert_masses
   use plydyn_domain_build_groups, only : add_group
   use plydyn_domain_chunks, only : set_targets
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_delamination, only : delamination_type
   use plydyn_domain_element_energies, only : dissipated_energies, stored_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_build, only : start_histories
   use plydyn_domain_local_to_global, only : local_to_global_type, new_local_to_global
   use plydyn_domain_step_limit, only : find_step_limit
   use plydyn_domain_subdomain, only : subdomain_type, take_chunks, take_columns
   use plydyn_element_group, only : element_group_type
   use plydyn_fem_columns, only : new_solid_columns
   use plydyn_law_law, only : by_friction, mechanisms
   use plydyn_method_forces, only : add_group_forces
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, finish
   implicit none

   !> Bars of steel, N, mm, s: the last is half as long as the others
   integer, parameter :: bars_in_row = 9
   real(wp), parameter :: young = 210.0e3_wp, density = 7.8e-9_wp, area = 2.0_wp, length = 4.0_wp, &
      & damping = 0.3_wp
   real(wp), parameter :: rounded = 1.0e-13_wp

   type(model_type) :: model
   type(domain_type) :: domain
   real(wp), allocatable :: force(:), history(:), u(:), v(:)
   integer, allocatable :: x(:)
   integer :: i

   call build()
   x = domain%columns%freedom(1, 1, 1, [(i, i=1, bars_in_row + 1)])
   allocate (u(domain%columns%freedoms), v(domain%columns%freedoms), force(domain%columns%forces))
   allocate (history(domain%histories), source=0.0_wp)

   call begin("masses")
   call check(sum(domain%inertia%mass), density*area*length*(bars_in_row - 0.5_wp), &
      & rounded*density*area*length*bars_in_row, "are those of the bars")

   call begin("stable step")
   domain%limit = find_step_limit(model, domain)
   call check(domain%limit%step, 0.5_wp*length/sqrt(young/density), &
      & rounded*length*sqrt(density/young), "a wave passes the shortest bar in it")
   call check(domain%limit%element_id, bars_in_row, "which has the user's number of it")
   call check(domain%groups(domain%limit%slowest(1)%group)%item%element_kind == "bar", &
      & "and is a bar")

   call begin("forces")
   call start_histories(model, domain, history)
   ! a strain of 0.1 % everywhere
   u(:) = 0.0_wp
   u(x) = 1.0e-3_wp*model%mesh%position(1, :)
   v(:) = 0.0_wp
   force(:) = 7.0_wp
   call add_group_forces(domain, domain%chunks%list(1), 1.0e-6_wp, u, v, history, force)
   call check(force(x(1)), 1.0e-3_wp*young*area, rounded*young*area, "pull the first node")
   call check(force(x(bars_in_row + 1)), -1.0e-3_wp*young*area, rounded*young*area, &
      & "and the last one")
   call check(maxval(abs(force(x(2:bars_in_row)))), 0.0_wp, rounded*young*area, &
      & "balance in between, whatever was there before")
   call check(-0.5_wp*dot_product(force(x), u(x)), &
      & 0.5_wp*young*1.0e-6_wp*area*length*(bars_in_row - 0.5_wp), rounded*young*area*length, &
      & "do the work of half E e**2 per volume")

   call begin("energies")
   v(x) = [(real(i, wp), i=1, bars_in_row + 1)]
   call add_group_forces(domain, domain%chunks%list(1), 1.0e-6_wp, 0.0_wp*u, v, history, force)
   call check_energies()
   call finish()

contains

   !> Bars in a row, as the only group of a domain of one rank
   subroutine build()
      class(element_group_type), allocatable :: group
      type(decomposition_type) :: division
      type(local_to_global_type) :: numbering
      type(subdomain_type) :: share
      integer :: c, e

      associate (mesh => model%mesh)
         mesh%node_id = [(100 + e, e=1, bars_in_row + 1)]
         allocate (mesh%position(3, bars_in_row + 1), source=0.0_wp)
         mesh%position(1, :) = [(length*(e - 1), e=1, bars_in_row + 1)]
         mesh%position(1, bars_in_row + 1) = mesh%position(1, bars_in_row) + 0.5_wp*length
         allocate (mesh%quad_id(0), mesh%brick_id(0), model%parts(0), domain%layers%order(0))
      end associate
      allocate (domain%groups(0), domain%inertia%ties(0))
      domain%columns = new_solid_columns(bars_in_row + 1)
      allocate (group, source=bar_group_type(set=1, part=1, young=young, density=density, &
         & area=area, damping=damping, mesh_node=reshape([(e, e + 1, e=1, bars_in_row)], &
         & [2, bars_in_row])))
      group%element_kind = "bar"
      group%layer_kind = "section"
      call add_group(group, domain)
      ! one chunk has all columns
      division%nodes = domain%columns%count
      division%columns = division%nodes
      division%column = [(c, c=1, division%nodes)]
      division%node = division%column
      allocate (division%parts(1), division%chunks(1), division%shared_nodes(3, 0))
      division%parts(1)%element = [(e, e=1, bars_in_row)]
      division%parts(1)%last = [bars_in_row]
      division%chunks(1)%set = 1
      division%chunks(1)%elements(:) = [1, bars_in_row]
      division%chunks(1)%column = division%column
      numbering = new_local_to_global(division, lanes, spread(0, 1, division%nodes), 0)
      call take_columns(model%mesh, division, numbering, domain, share)
      call take_chunks(division, [.true.], domain)
      call build_masses(model, division, numbering, domain)
      call invert_masses(domain)
      call build_elements(model, division, numbering, domain, share)
      call set_targets(domain)
   end subroutine build

   !> A unit velocity between the ends of every damper, for a microsecond
   subroutine check_energies()
      type(delamination_type) :: none(0)
      real(wp) :: energy(mechanisms)

      energy(:) = dissipated_energies(domain, history, none)
      call check(energy(by_friction), 1.0e-6_wp*damping*bars_in_row, rounded*damping, &
         & "the dampers take force times velocity times step")
      call check(sum(energy), energy(by_friction), 0.0_wp, "and nothing else takes any")
      u(x) = 1.0e-3_wp*model%mesh%position(1, :)
      call check(stored_energies(domain, u, history), [0.5_wp*young*1.0e-6_wp*area*length &
         & *(bars_in_row - 0.5_wp), 0.0_wp, 0.0_wp], rounded*young*area*length, &
         & "the bars store half E e**2, and need no hourglass control")
   end subroutine check_energies

end program test_element_group
