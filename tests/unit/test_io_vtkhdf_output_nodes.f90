!> Sites: nodes of each part apart, and means over the elements that meet at one.
program test_io_vtkhdf_output_nodes
   use plydyn_base_precision, only : wp
   use plydyn_io_vtkhdf_output_nodes, only : new_accumulators, number_nodes, accumulators_type
   use plydyn_parallel_comm, only : comm_type
   use testing, only : begin, check, finish
   implicit none

   !> Three quads in a row, the last of another part
   integer, parameter :: part(3) = [1, 1, 2]
   integer, parameter :: quad(4, 3) = reshape([1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7], [4, 3])
   integer, allocatable :: node(:), output_node(:, :)

   call numbers()
   call means()
   call finish()

contains

   !> Nodes 3 and 7 are in both parts
   subroutine numbers()
      call begin("number_nodes")
      call number_nodes(part, quad, 9, output_node, node)
      call check(all(node == [1, 2, 3, 5, 6, 7, 3, 4, 7, 8]), "one part, then the other")
      call check(all(output_node(:, 2) == [2, 3, 6, 5]), "a quad of the first part")
      call check(all(output_node(:, 3) == [7, 8, 10, 9]), "one of the second")
   end subroutine numbers

   !> Weights of 1 and 3 at the nodes that two quads share
   subroutine means()
      type(accumulators_type) :: accumulators
      real(wp) :: mean(1, 20), values(2, 2, 10)
      integer :: e, k, n

      call begin("mean")
      accumulators = new_accumulators(comm_type(), output_node, [1, 2, 3], 2)
      call check(accumulators%count == 10 .and. accumulators%own_points() == 20, &
         & "every output node and level once")
      values(:, :, :) = 0.0_wp
      do e = 1, 3
         do n = 1, 4
            do k = 1, 2
               associate (sums => values(:, k, accumulators%place(n, e)), &
                  & weight => 2.0_wp*e - 1.0_wp)
                  sums(1) = sums(1) + weight*(10.0_wp*e + k)
                  sums(2) = sums(2) + weight
               end associate
            end do
         end do
      end do
      call accumulators%mean(values, mean)
      call check(mean(1, 1), 11.0_wp, 1.0e-12_wp, "one quad alone")
      call check(mean(1, 2), 18.5_wp, 1.0e-12_wp, "two quads: (11 + 3*21)/4")
      call check(mean(1, 3), 21.0_wp, 1.0e-12_wp, "a node of two parts has the value of each")
      call check(mean(1, 7), 31.0_wp, 1.0e-12_wp, "as here")
      call check(mean(1, 12), 19.5_wp, 1.0e-12_wp, "the level above")
   end subroutine means

end program test_io_vtkhdf_output_nodes
