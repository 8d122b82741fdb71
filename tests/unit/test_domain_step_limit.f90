!> Which elements have the smallest stable steps, whatever order they come in.
program test_domain_step_limit
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : critical_element_type
   use plydyn_domain_step_limit, only : find_slowest
   use plydyn_parallel_comm, only : comm_type
   use testing, only : begin, check, finish
   implicit none

   !> Elements of the mesh; every fifth has the same eigenvalue, the largest
   integer, parameter :: n = 31
   type(comm_type) :: comm
   type(critical_element_type), allocatable :: slowest(:)
   integer :: e, turned(n)
   real(wp) :: rate(n)

   rate(:) = [(merge(100.0_wp, real(e, wp), mod(e, 5) == 0), e=1, n)]

   call begin("find_slowest")
   slowest = find_slowest(comm, [(critical_element_type(2, e, 1000 + e, rate(e)), e=1, n)])
   call check(size(slowest), 20, "no more than are named")
   call check(all(slowest(:6)%element == [5, 10, 15, 20, 25, 30]), &
      & "the first of the mesh comes first of equal ones")
   call check(all(slowest(7:9)%element == [31, 29, 28]), "then the next largest eigenvalue")
   call check(all(slowest%group == 2), "each has its group")
   call check(all(slowest%layer == 1000 + slowest%element), "each has its layer")
   call check(maxval(abs(slowest%rate - rate(slowest%element))), 0.0_wp, 0.0_wp, &
      & "and its eigenvalue")

   turned(:) = [(1 + mod(7*e, n), e=1, n)]
   call check(all(slowest%element == elements(find_slowest(comm, &
      & [(critical_element_type(1, turned(e), turned(e), rate(turned(e))), e=1, n)]))), &
      & "in whatever order a rank has them")
   call check(size(find_slowest(comm, [critical_element_type(1, 4, 1, 1.0_wp), &
      & critical_element_type(1, 2, 1, 3.0_wp)])), 2, &
      & "all there are of a small mesh")
   call finish()

contains

   !> Indices in the mesh
   pure function elements(slow)
      type(critical_element_type), intent(in) :: slow(:)
      integer :: elements(size(slow))

      elements(:) = slow%element
   end function elements

end program test_domain_step_limit
