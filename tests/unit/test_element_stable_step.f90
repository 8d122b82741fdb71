!> The stable step against the eigenvalues of a whole small mesh.
program test_element_stable_step
   use acceleration, only : accelerate_points
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_quad, only : tensor_order
   use plydyn_element_stable_step, only : certified_bound, largest_eigenvalues, power_iteration
   use plydyn_law_cohesive_bilinear, only : cohesive_constants_type
   use plydyn_model_control, only : all_explicit, implicit_interfaces, implicit_thickness
   use plydyn_model_layup, only : faces_tied
   use plydyn_model_material, only : interface_material_type
   use plydyn_model_model, only : model_type
   use plydyn_parallel_thread_team, only : thread_team_type, new_thread_team
   use plydyn_method_forces, only : find_internal_forces
   use plydyn_state_state, only : motion_sums_type
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> LAPACK: eigenvalues of a general matrix
   interface
      subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
         import :: wp
         implicit none
         character(1), intent(in) :: jobvl, jobvr
         integer, intent(in) :: n, lda, ldvl, ldvr, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: wr(*), wi(*), vl(ldvl, *), vr(ldvr, *), work(*)
         integer, intent(out) :: info
      end subroutine dgeev
   end interface

   real(wp), parameter :: matrix(3, 3) = reshape([2.0_wp, -1.0_wp, 0.0_wp, -1.0_wp, 2.0_wp, &
      & -1.0_wp, 0.0_wp, -1.0_wp, 2.0_wp], [3, 3])
   real(wp), parameter :: largest = 2.0_wp + sqrt(2.0_wp)
   !> Plies joined by interface material 1
   integer, parameter :: springs = 1
   integer :: order, side

   call begin("power iteration")
   call check(power_iteration(matrix), largest, 1.0e-9_wp, "finds the largest eigenvalue")
   call begin("certified bound")
   call check(certified_bound(matrix, largest) >= largest, "is not below it")
   call check(certified_bound(matrix, largest) <= 1.003_wp*largest, "nor far above")
   call check(certified_bound(matrix, 0.7_wp*largest) >= largest, &
      & "even if the estimate was too small")

   do side = 2, 3
      do order = 1, 2
         call test_mesh(side, order, all_explicit)
         call test_mesh(side, order, implicit_thickness)
      end do
      call test_scaled(side, all_explicit, faces_tied)
      call test_scaled(side, all_explicit, springs)
      call test_scaled(side, implicit_interfaces, springs)
      call test_scaled(side, implicit_thickness, springs)
   end do
   do side = 2, 3
      call test_alone(side)
   end do
   call finish()

contains

   !> The bound of a quad has the same bits with others and alone, and wherever the quad lies
   subroutine test_alone(side)
      integer, intent(in) :: side

      real(wp), parameter :: surface_density = 4.25e-10_wp
      type(domain_type) :: domain
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp), allocatable :: corner(:, :, :), density(:, :), each(:, :, :), lambda(:, :, :)
      integer :: e

      call begin("largest_eigenvalues")
      model = rectangle_model(rectangle_mesh(side, 4, 3, 2.8_wp, 2.1_wp, 0.05_wp), &
         & [0.0_wp, 60.0_wp], 0.25_wp, [1, 1])
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      corner = reshape([(model%mesh%position(1:2, model%mesh%quad_node(tensor_order(side), e)), &
         & e=1, 12)], [2, side**2, 12])
      ! the first quad once more, behind all others
      corner = reshape([corner, corner(:, :, 1) + 64.0_wp], [2, side**2, 13])
      plate = plate_of(domain, 1)
      associate (batch => plate%batches(1))
         density = merge(surface_density, 0.0_wp, batch%layer > 0)
         allocate (lambda(size(density, 1), size(density, 2), 13))
         allocate (each, mold=lambda)
         call largest_eigenvalues(batch, density, side, corner, 0.0_wp, lambda)
         do e = 1, 13
            call largest_eigenvalues(batch, density, side, corner(:, :, e:e), 0.0_wp, &
               & each(:, :, e:e))
         end do
      end associate
      call check(all(lambda(1:2, 1, :) > 0.0_wp), "is found")
      call check(maxval(abs(lambda - each)), 0.0_wp, 0.0_wp, "does not depend on other quads")
      call check(maxval(abs(lambda(:, :, 13) - lambda(:, :, 1))), 0.0_wp, 0.0_wp, &
         & "nor on where the quad lies")
   end subroutine test_alone

   !> The bound lies above the largest eigenvalue of the mesh, and close to it
   subroutine test_mesh(side, order, scheme)
      integer, intent(in) :: side, order, scheme

      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp) :: exact

      call begin("stable step")
      model = rectangle_model(rectangle_mesh(side, 2, 1, 2.0_wp, 1.0_wp, 0.05_wp), &
         & [0.0_wp, 60.0_wp], 0.25_wp, [order, order])
      model%control%scheme = scheme
      model%control%step_factor = 1.0_wp
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      ! with the inertia that is added for this step
      exact = 2.0_wp/sqrt(largest_eigenvalue(domain, .true.))
      call check(domain%limit%step <= exact, "is not above that of the mesh")
      call check(domain%limit%step >= 0.8_wp*exact, "nor far below: elements bound their mesh")
   end subroutine test_mesh

   !> With added mass, no eigenvalue of a mesh of unlike elements is above that of the step that the
   !> deck asks for, between the largest and the smallest of its own
   subroutine test_scaled(side, scheme, joint)
      !> Nodes along a side, what is implicit, and what joins the plies
      integer, intent(in) :: side, scheme, joint

      real(wp), parameter :: stiffness(2) = [3.0e4_wp, 2.0e4_wp], times = 1.5_wp
      type(domain_type) :: domain, plain
      type(error_type), allocatable :: error
      type(model_type) :: model
      real(wp) :: largest, step

      call begin("mass scaling")
      model = rectangle_model(rectangle_mesh(side, 2, 1, 2.0_wp, 1.0_wp, 0.1_wp), &
         & [0.0_wp, 60.0_wp], 0.25_wp, [1, 1])
      model%parts(1)%plies(2)%thickness = 0.4_wp
      model%parts(1)%joint(:) = joint
      model%control%scheme = scheme
      model%control%step_factor = 1.0_wp
      model%interface_materials = [interface_material_type(id=1, title="springs", &
         & constants=cohesive_constants_type(stiffness=stiffness))]
      call build_domain(model, plain, error)
      step = times*plain%limit%step
      model%control%mass_scaled_step = step
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      call check(domain%step, step, 0.0_wp, "the step is that of the deck")
      call check(domain%limit%unscaled_step, plain%limit%step, 0.0_wp, "its own is known")
      largest = largest_eigenvalue(domain, joint == faces_tied)
      call check(2.0_wp/sqrt(largest) >= step, "it is stable for the mesh")
      associate (added => domain%inertia%added(1))
         call check(sum(domain%inertia%mass) - sum(plain%inertia%mass), added%added, &
            & 1.0e-12_wp*added%own, "the points have what the part has got")
         call check(sum(plain%inertia%mass), added%own, 1.0e-12_wp*added%own, "and its own mass")
         call check(added%largest <= times**2*(1.0_wp + 1.0e-12_wp), &
            & "no element has more than the one that sets the step")
         call check(added%elements, 4, "each layer of a quad is an element")
      end associate
   end subroutine test_scaled

   !> Largest eigenvalue of K x = lambda M x, column by column through forces and accelerations
   real(wp) function largest_eigenvalue(domain, is_tied) result(lambda)
      type(domain_type), intent(in) :: domain
      !> Whether the plies move as one where they meet
      logical, intent(in) :: is_tied

      type(thread_team_type) :: team
      type(motion_sums_type) :: sums
      integer, allocatable :: free(:)
      real(wp), allocatable :: a(:), history(:), k(:, :), left(:, :), right(:, :), u(:), wi(:)
      real(wp), allocatable :: work(:), wr(:)
      integer :: i, info, n

      free = independent(domain, is_tied)
      n = size(free)
      allocate (a(domain%columns%freedoms), u(domain%columns%freedoms), k(n, n), wr(n), wi(n))
      allocate (work(8*n), left(1, 1), right(1, 1))
      allocate (history(domain%histories), source=0.0_wp)
      do i = 1, n
         u(:) = 0.0_wp
         u(free(i)) = 1.0_wp
         if (is_tied) u(twins(domain, free(i))) = 1.0_wp
         a(:) = 0.0_wp
         call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
         call find_internal_forces(domain, team, 0.0_wp, u, &
            & 0.0_wp*u, history, a)
         call accelerate_points(domain, 0.0_wp, u, a, sums)
         k(:, i) = -a(free)
      end do
      call dgeev("N", "N", n, k, n, wr, wi, left, 1, right, 1, work, size(work), info)
      call check(info == 0, "LAPACK finds the eigenvalues")
      lambda = maxval(wr)
   end function largest_eigenvalue

   !> Places of all points but the upper ones of tied faces
   function independent(domain, is_tied) result(free)
      type(domain_type), intent(in) :: domain
      logical, intent(in) :: is_tied
      integer, allocatable :: free(:)
      integer :: c, n, t

      allocate (free(0))
      do n = 1, domain%columns%nodes
         do c = 1, 3
            free = [free, (domain%columns%freedom(1, t, c, n), t=1, domain%columns%levels(1)), &
               & (domain%columns%freedom(2, t, c, n), t=merge(2, 1, is_tied), &
               & domain%columns%levels(2))]
         end do
      end do
   end function independent

   !> A place and the one that is tied to it
   function twins(domain, freedom) result(places)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: freedom
      integer, allocatable :: places(:)
      integer :: c, n

      places = [freedom]
      do n = 1, domain%columns%nodes
         do c = 1, 3
            if (domain%columns%freedom(1, domain%columns%levels(1), c, n) == freedom) then
               places = [freedom, domain%columns%freedom(2, 1, c, n)]
               return
            end if
         end do
      end do
   end function twins

end program test_element_stable_step
