!> Warnings of constants of plies that can be, but that no ply has: other units, other ratios; notes
!> of laminates that pulling bends.
!>
!> `plydyn-pre` has the same bounds for recipes; the manual, "Constants that no ply has", says them.
module plydyn_input_check_plies
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_report, only : deck_location_type
   use plydyn_input_catalogue, only : a_material, a_part, catalogue_type
   use plydyn_law_law, only : law_constants_type
   use plydyn_law_ply_constants, only : damaged_ply_type
   use plydyn_law_ply_shear_curve, only : shape_table, shear_curve_type
   use plydyn_model_layup, only : ply_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: check_layups, check_plies, strength_range

   !> Strain across from stress along the fibres, at most; along from stress across, least and most
   real(wp), parameter :: largest_major = 0.5_wp, minor_range(2) = [0.005_wp, 0.5_wp]
   !> Moduli over strengths, least and most
   real(wp), parameter :: strength_range(2) = [20.0_wp, 2000.0_wp]
   !> First slope of a curve of shear over G12: what is usual, and what can only be a mistake
   real(wp), parameter :: usual_slope(2) = [0.7_wp, 1.3_wp], wrong_slope(2) = [0.05_wp, 20.0_wp]
   !> Angle after which a direction is the same, degrees
   real(wp), parameter :: half_turn = 180.0_wp
   !> Share of an angle or a thickness by which equal ones may differ
   real(wp), parameter :: round_off = 1.0e-9_wp
   !> Error of an angle that is written with three digits behind the point, or fewer
   real(wp), parameter :: rounded = 1.0e-3_wp

contains

   !> Look at the ratios of all materials, and at strengths and curves of those that are damaged
   subroutine check_plies(model, catalogue)
      type(model_type), intent(in) :: model
      !> Gets findings
      type(catalogue_type), intent(inout) :: catalogue

      type(deck_location_type) :: place
      integer :: i

      do i = 1, size(model%materials)
         place = catalogue%location(a_material, i)
         call check_ratios(model%materials(i)%law, place, catalogue)
         select type (law => model%materials(i)%law)
         class is (damaged_ply_type)
            call check_strengths(law, [law%fibre_strength, law%matrix_strength, &
               & law%shear_strength], place, catalogue)
            call check_slope(law%curve, law%shear(1), place, catalogue)
         end select
      end do
   end subroutine check_plies

   !> Poisson's ratios of stress along the fibres
   subroutine check_ratios(law, place, catalogue)
      class(law_constants_type), intent(in) :: law
      !> Where the deck has the material
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      character(1), parameter :: digit(3) = ["1", "2", "3"]
      real(wp) :: major, minor
      integer :: k

      do k = 2, 3
         major = law%poisson(k - 1)
         minor = major*law%young(k)/law%young(1)
         if (major > largest_major) then
            call catalogue%report%warn(place, "nu1"//digit(k)//" = "//text(major, 4)//", the " &
               & //"strain across from stress along the fibres, is above 0.5", &
               & "0.2 to 0.4, usually")
         else if (k == 2 .and. major > 0.0_wp .and. (minor < minor_range(1) &
            & .or. minor > minor_range(2))) then
            call catalogue%report%warn(place, "nu12 = "//text(major, 4)//" gives nu21 = " &
               & //text(minor, 3), "nu21 of 0.005 to 0.5, usually; nu12 = nu21 E1/E2 where " &
               & //text(major, 4)//" is nu21")
         end if
      end do
   end subroutine check_ratios

   !> Strengths far from their modulus
   subroutine check_strengths(law, strength, place, catalogue)
      class(law_constants_type), intent(in) :: law
      !> XT, XC, YT, YC, S
      real(wp), intent(in) :: strength(5)
      !> Where the deck has the material
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      character(2), parameter :: names(5) = ["XT", "XC", "YT", "YC", "S "]
      character(3), parameter :: moduli(5) = ["E1 ", "E1 ", "E2 ", "E2 ", "G12"]
      real(wp) :: modulus(5), ratio
      integer :: i

      modulus(:) = [law%young([1, 1, 2, 2]), law%shear(1)]
      do i = 1, size(strength)
         if (strength(i) <= 0.0_wp) cycle
         ratio = modulus(i)/strength(i)
         if (ratio >= strength_range(1) .and. ratio <= strength_range(2)) cycle
         call catalogue%report%warn(place, trim(names(i))//" = "//text(strength(i))//" is " &
            & //trim(moduli(i))//"/"//text(ratio, 3), trim(moduli(i))//"/2000 to " &
            & //trim(moduli(i))//"/20, usually, in the units of the moduli")
      end do
   end subroutine check_strengths

   !> A curve of shear that begins with another slope than G12
   subroutine check_slope(curve, modulus, place, catalogue)
      type(shear_curve_type), intent(in) :: curve
      !> G12
      real(wp), intent(in) :: modulus
      !> Where the deck has the material
      type(deck_location_type), intent(in) :: place
      type(catalogue_type), intent(inout) :: catalogue

      character(:), allocatable :: words
      real(wp) :: share

      if (curve%shape /= shape_table) return
      share = curve%stress(2)/(curve%strain(2)*modulus)
      if (share >= usual_slope(1) .and. share <= usual_slope(2)) return
      words = "the curve of shear begins with "//text(share, 2)//" of G12 = "//text(modulus)
      if (share < wrong_slope(1) .or. share > wrong_slope(2)) then
         call catalogue%report%refuse(place, words, "strain without unit (1 % is 0.01), and " &
            & //"stress in the unit of G12")
      else
         call catalogue%report%warn(place, words, "0.7 to 1.3, usually: a curve that belongs to " &
            & //"this G12")
      end if
   end subroutine check_slope

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

end module plydyn_input_check_plies
