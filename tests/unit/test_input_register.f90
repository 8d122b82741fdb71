!> Numbers in any order are found again.
program test_input_register
   use plydyn_input_register, only : register_type
   use testing, only : begin, check, finish
   implicit none

   integer, parameter :: many = 1000, prime = 1009, step = 371
   type(register_type) :: register, empty
   integer :: i
   logical :: found

   call begin("index_of")
   call empty%sort()
   call check(empty%index_of(1), 0, "finds nothing in an empty register")
   do i = 1, many
      call register%add(modulo(i*step, prime), i)
   end do
   call register%sort()
   found = .true.
   do i = 1, many
      found = found .and. register%index_of(modulo(i*step, prime)) == i
   end do
   call check(found, "finds every number of a shuffled thousand")
   call check(register%index_of(0), 0, "finds no number that is not there")
   call check(register%index_of(prime), 0, "nor one behind the last")
   call check(all(register%id(register%order(2:)) > register%id(register%order(:many - 1))), &
      & "the order is increasing")

   call register%add(step, many + 1)
   call register%sort()
   call check(register%index_of(step), 1, "the first definition of a number counts")

   call begin("refer")
   call check(.not. register%used(7), "nothing is used at first")
   call register%refer(register%id(7), i)
   call check(i, 7, "gives the place of a number")
   call check(register%used(7) .and. .not. register%used(8), "which is used from then on")
   call register%refer(prime, i)
   call check(i == 0 .and. count(register%used(:many)) == 1, "and none for another")

   call finish()
end program test_input_register
