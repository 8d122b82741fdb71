!> Notes of laminates that pulling bends.
module plydyn_input_check_layup
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_input_catalogue, only : a_part, catalogue_type
   use plydyn_model_layup, only : ply_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_layups

   !> Angle after which a direction is the same, degrees
   real(wp), parameter :: half_turn = 180.0_wp
   !> Share of an angle or a thickness by which equal ones may differ
   real(wp), parameter :: round_off = 1.0e-9_wp
   !> Error of an angle that is written with three digits behind the point, or fewer
   real(wp), parameter :: rounded = 1.0e-3_wp

contains

   !> Note laminates without symmetry; an s may be missing behind their notation
   subroutine check_layups(model, catalogue)
      !> A sound model
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      integer :: p

      do p = 1, size(model%parts)
         call check_angles(model, p, catalogue)
      end do
      if (is_kept_plane(model)) return
      do p = 1, size(model%parts)
         if (is_symmetric(model%parts(p)%plies)) cycle
         call catalogue%report%note(catalogue%location(a_part, p), "the laminate of part " &
            & //text(model%parts(p)%id)//" is not symmetric about its middle, so that pulling " &
            & //"bends it", "an s may be missing behind its notation")
      end do
   end subroutine check_layups

   !> Warn of angles that look like radians: within a half turn of them, and each 0 or a multiple of
   !> 15 degrees; and of those beyond a turn
   subroutine check_angles(model, p, catalogue)
      type(model_type), intent(in) :: model
      !> Index of the part
      integer, intent(in) :: p
      type(catalogue_type), intent(inout) :: catalogue

      real(wp), parameter :: half = acos(-1.0_wp), step = half/12.0_wp
      real(wp) :: largest

      associate (angle => model%parts(p)%plies%angle)
         largest = maxval(abs(angle))
         if (largest > 2.0_wp*half_turn) then
            call catalogue%report%warn(catalogue%location(a_part, p), "a ply of part " &
               & //text(model%parts(p)%id)//" has an angle of "//text(largest)//" degrees", &
               & "-90 to 90")
         else if (largest > 0.5_wp*step .and. largest < half + step .and. all(abs(angle &
            & - step*anint(angle/step)) < rounded)) then
            call catalogue%report%warn(catalogue%location(a_part, p), "the angles of part " &
               & //text(model%parts(p)%id)//", up to "//text(largest)//", look like radians", &
               & "degrees, such as "//text(nint(largest/half*half_turn)))
         end if
      end associate
   end subroutine check_angles

   !> Whether a support holds z at all nodes, such as at the middle of a plate of which this is half
   pure logical function is_kept_plane(model)
      type(model_type), intent(in) :: model

      integer :: k
      logical :: held(size(model%mesh%node_id))

      is_kept_plane = .false.
      do k = 1, size(model%supports)
         if (.not. model%supports(k)%direction(3)) cycle
         held(:) = .false.
         held(model%supports(k)%nodes) = .true.
         is_kept_plane = is_kept_plane .or. all(held(pack(model%mesh%quad_node, .true.)))
      end do
   end function is_kept_plane

   !> Whether plies are the same from the bottom and from the top
   pure logical function is_symmetric(plies)
      type(ply_type), intent(in) :: plies(:)

      real(wp) :: turn
      integer :: k, other

      is_symmetric = .true.
      do k = 1, size(plies)/2
         other = size(plies) + 1 - k
         turn = (plies(k)%angle - plies(other)%angle)/half_turn
         is_symmetric = is_symmetric .and. plies(k)%material == plies(other)%material &
            & .and. abs(turn - anint(turn)) <= round_off &
            & .and. abs(plies(k)%thickness - plies(other)%thickness) &
            & <= round_off*plies(k)%thickness
      end do
   end function is_symmetric

end module plydyn_input_check_layup
