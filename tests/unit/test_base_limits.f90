!> Control groups leave what the tightest of them has not given away.
program test_base_limits
   use plydyn_base_limits, only : available_memory, bytes_left_by_groups
   use plydyn_base_precision, only : wp
   use testing, only : begin, check, finish, write_lines
   implicit none

   !> Folder of the groups, and the file that names those of the process
   character(*), parameter :: root = "test_base_limits.groups", list = root//"/list"

   call begin("bytes_left_by_groups")
   call execute_command_line("mkdir -p "//root//"/outer/inner")
   call write_lines(root//"/outer/memory.max", "900|")
   call write_lines(root//"/outer/memory.stat", "file 50|anon 300|")
   call write_lines(root//"/outer/inner/memory.max", "1000|")
   call write_lines(root//"/outer/inner/memory.stat", "anon 100|")
   call write_lines(list, "0::/outer/inner|")
   call check(left(), 600.0_wp, 0.0_wp, "the group outside is tighter")
   call write_lines(root//"/outer/inner/memory.max", "500|")
   call check(left(), 400.0_wp, 0.0_wp, "the group inside is tighter")
   call write_lines(list, "1:name=some:/other|0::/outer/inner|2:cpu:/another|")
   call check(left(), 400.0_wp, 0.0_wp, "among groups of version 1")
   call write_lines(root//"/outer/inner/memory.stat", "anon 501|")
   call check(left(), 0.0_wp, 0.0_wp, "nothing is left of what is overdrawn")
   call write_lines(root//"/outer/inner/memory.max", "max|")
   call check(left(), 600.0_wp, 0.0_wp, "one without a limit")
   call write_lines(list, "0::/outer|")
   call check(left(), 600.0_wp, 0.0_wp, "one group alone")
   call write_lines(list, "1:name=some:/outer|")
   call check(left() >= huge(1.0_wp), "no group of version 2 limits nothing")
   call check(bytes_left_by_groups(root//"/none", root) >= huge(1.0_wp), "nor do no groups")

   call begin("available_memory")
   call check(available_memory() > 0.0_wp, "is some")
   call check(available_memory() < 1.0e16_wp, "is that of a machine")
   call finish()

contains

   !> What the groups of the list leave
   real(wp) function left()
      left = bytes_left_by_groups(list, root)
   end function left

end program test_base_limits
