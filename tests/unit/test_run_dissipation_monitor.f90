!> A dissipated energy that falls is reported once, with its name; what rises is not.
program test_run_dissipation_monitor
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_io_job, only : job_type
   use plydyn_method_element_balance, only : element_balance_type
   use plydyn_method_observer, only : requests_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_run_dissipation_monitor, only : dissipation_monitor_type, new_dissipation_monitor
   use plydyn_run_setup, only : new_state
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Longest line of the listing
   integer, parameter :: longest = 500

   type(simulation_type) :: simulation
   type(dissipation_monitor_type) :: monitor
   type(error_type), allocatable :: error
   type(job_type) :: job
   integer :: i

   simulation%model = rectangle_model(rectangle_mesh(3, 2, 2, 10.0_wp, 10.0_wp, 0.0_wp), &
      & [0.0_wp, 90.0_wp], 0.25_wp, [1, 1])
   simulation%model%control%end_time = 1.0_wp
   simulation%model%control%units%energy = "mJ"
   allocate (simulation%domain)
   call build_domain(simulation%model, simulation%domain, error)
   call new_state(simulation%model, simulation%domain, simulation%state)
   simulation%state%energies%reference = 1000.0_wp
   open (newunit=job%listing, status="scratch", action="readwrite")
   monitor = new_dissipation_monitor(job, simulation%state)

   call begin("notify")
   do i = 0, 20
      simulation%state%energies%contact = 2.0_wp*i - merge(1.0_wp, 0.0_wp, i == 7)
      simulation%state%energies%friction = 1.0_wp*i
      call look([0.0_wp, 0.5_wp*i, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   end do
   call check(lines(), 0, "rising energies are well, and one that falls by a thousandth")
   simulation%state%energies%contact = 40.0_wp - 5.1_wp
   call look([0.0_wp, 10.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   call check(lines(), 1, "contact that has given a little more than 0.5 %")
   call check(index(line(1), "warning: the energy of contact ") == 1, "has its name")
   call check(index(line(1), "fallen by 5.1 mJ, 0.51 % of the energy that went in") > 0, "amount")
   simulation%state%energies%contact = 0.0_wp
   call look([0.0_wp, 10.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   call check(lines(), 1, "it is reported once")
   call look([0.0_wp, 4.9_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   call check(lines(), 2, "a mechanism of plies")
   call check(index(line(2), "the energy of matrix damage has fallen") > 0, "has its name")
   simulation%state%energies%friction = 0.0_wp
   call look([0.0_wp, 4.9_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   call check(index(line(3), "the energy of contact friction has fallen") > 0, "friction")
   simulation%state%energies%damping = -600.0_wp
   call look([0.0_wp, 4.9_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   call check(lines(), 3, "damping may push where contact turns the velocity")
   call finish()

contains

   !> A step with energies that mechanisms have dissipated
   subroutine look(dissipated)
      real(wp), intent(in) :: dissipated(:)

      type(requests_type) :: requests

      allocate (requests%balance)
      requests%balance = element_balance_type()
      requests%balance%dissipated(:) = dissipated
      call monitor%notify(simulation, requests, error)
   end subroutine look

   !> How many lines the listing has
   integer function lines()
      character(longest) :: words
      integer :: status

      rewind (job%listing)
      lines = 0
      do
         read (job%listing, "(a)", iostat=status) words
         if (status /= 0) exit
         lines = lines + 1
      end do
      backspace (job%listing)
   end function lines

   !> A line of the listing
   function line(number) result(words)
      integer, intent(in) :: number
      character(longest) :: words

      integer :: i, last

      last = lines()
      words = ""
      if (number > last) return
      rewind (job%listing)
      do i = 1, number
         read (job%listing, "(a)") words
      end do
      ! what is written next goes behind the last line
      i = lines()
   end function line

end program test_run_dissipation_monitor
