!> The worst point of a motion, named by the user's numbers.
!>
!> Each rank looks at its own points; of several that are equally bad, the point with the least
!> number is named.
module plydyn_run_worst_point
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: moment, name_of, worst_point

   !> Names of the directions
   character(1), parameter :: axis(3) = ["x", "y", "z"]

   !> The worst point of some
   type, public :: worst_point_type
      !> Speed, or another measure; negative for no point
      real(wp) :: badness = -1.0_wp
      !> The user's number of the node, and layer and direction there
      integer :: node_id = huge(1), layer = 1, direction = 1
   end type worst_point_type

contains

   !> Direction and place of a point, in the user's numbers
   function name_of(worst, domain, model) result(words)
      !> The point
      type(worst_point_type), intent(in) :: worst
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      character(:), allocatable :: words

      words = axis(worst%direction)//" at node "//text(worst%node_id)
      if (any(domain%layers%order > 0)) then
         words = words//", ply "//text(domain%layers%ply(worst%layer))//" from the bottom"
      end if
      words = words//", part "//text(part_at(domain, model, worst%node_id))
   end function name_of

   !> The user's number of the first part that has a node; 0 for none
   pure integer function part_at(domain, model, node_id) result(id)
      type(domain_type), intent(in) :: domain
      type(model_type), intent(in) :: model
      !> The user's number of the node
      integer, intent(in) :: node_id

      integer :: e, g, place
      integer, allocatable :: node(:, :), part(:)

      id = 0
      place = findloc(model%mesh%node_id, node_id, dim=1)
      do g = 1, size(domain%groups)
         call model%mesh%list_elements(domain%groups(g)%item%element_kind, part, node)
         do e = 1, size(part)
            if (.not. any(node(:, e) == place)) cycle
            id = model%parts(part(e))%id
            return
         end do
      end do
   end function part_at

   !> Cycle and time
   function moment(state) result(words)
      type(state_type), intent(in) :: state
      character(:), allocatable :: words

      words = " at cycle "//text(state%cycle)//", time "//text(state%time)
   end function moment

   !> The point of the whole model with the largest number; of several alike that of the node with
   !> the least number of the user, and there the lowest
   type(worst_point_type) function worst_point(domain, badness) result(worst)
      type(domain_type), intent(in) :: domain
      !> Numbers at the places of the arrays of motion
      real(wp), intent(in) :: badness(:)

      integer :: place(2)

      worst = worst_here(domain, badness)
      ! ranks that meet at the node have the same motion there
      place(:) = [worst%direction, worst%layer]
      call domain%comm%keep_largest(worst%badness, worst%node_id, place)
      worst%direction = place(1)
      worst%layer = place(2)
   end function worst_point

   !> The same of the points that this rank has
   pure type(worst_point_type) function worst_here(domain, badness) result(worst)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: badness(:)

      integer :: c, k, n, t

      do n = 1, domain%columns%nodes
         do k = 1, size(domain%columns%layer_slot, 2)
            do t = 1, domain%columns%levels(k)
               do c = 1, 3
                  associate (own => badness(domain%columns%freedom(k, t, c, n)))
                     if (own > worst%badness .or. (own >= worst%badness &
                        & .and. domain%node_id(n) < worst%node_id)) then
                        worst = worst_point_type(own, domain%node_id(n), k, c)
                     end if
                  end associate
               end do
            end do
         end do
      end do
   end function worst_here

end module plydyn_run_worst_point
