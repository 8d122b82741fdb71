!> Damage begins where it must: at the strengths, or earlier where the crack band is too wide.
program test_law_ply_damage_onset
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_constants, only : onset_hashin, ply_constants_type, snap_drop
   use plydyn_law_ply_history, only : fibre_damage, fibre_onset, matrix_damage, matrix_energy, &
      & matrix_finish, matrix_onset
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Crack bands narrow enough for every mode
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.25_wp]
   !> Steps of a fine path to the end of softening
   integer, parameter :: steps = 4000

   call test_shear_toughness()
   call test_reduced_strengths()
   call test_drop()
   call test_hashin()
   call finish()

contains

   !> A toughness of shear counts by its share of the work
   subroutine test_shear_toughness()
      type(point_type) :: point
      type(ply_constants_type) :: ply

      call begin("shear toughness")
      ply = paper_ply()
      ply%shear_toughness = 0.79_wp
      point = new_point(ply, narrow)
      call point%pull(2, 0.0_wp, 0.02_wp)
      call check(point%history(matrix_finish), 2.0_wp*0.79_wp/(narrow(2)*90.0_wp), 1.0e-12_wp, &
         & "rules in shear")
      point = new_point(ply, narrow)
      call point%pull(2, 0.01_wp, 0.0_wp)
      call check(point%history(matrix_finish), 2.0_wp*0.22_wp/(narrow(2)*82.0_wp), 1.0e-12_wp, &
         & "does nothing in tension")
   end subroutine test_shear_toughness

   !> A crack band that is too wide: damage starts early and dissipates the toughness
   subroutine test_reduced_strengths()
      real(wp), parameter :: wide(3) = [0.5_wp, 1.0_wp, 1.5_wp]
      real(wp), parameter :: tension(3) = [82.0_wp, 67.3_wp, 55.0_wp]
      real(wp), parameter :: compression(3) = [212.9_wp, 150.5_wp, 122.9_wp]
      real(wp), parameter :: shear(3) = [72.7_wp, 51.4_wp, 42.0_wp]
      type(point_type) :: point
      type(ply_constants_type) :: ply
      integer :: i

      call begin("reduced strengths")
      ply = paper_ply()
      ply%snap_ratio = 1.0_wp
      do i = 1, 3
         call check(strength(ply, wide(i), [0.1_wp, 0.0_wp]), tension(i), 0.05_wp, &
            & "of matrix tension are those of an independent program")
         call check(strength(ply, wide(i), [-0.1_wp, 0.0_wp]), compression(i), 0.05_wp, &
            & "of matrix compression too")
         call check(strength(ply, wide(i), [0.0_wp, 0.1_wp]), shear(i), 0.05_wp, &
            & "of shear too")
      end do

      ply%snap_ratio = 1.05_wp
      ply%residual = 1.0e-9_wp
      point = new_point(ply, [1.0_wp, 1.5_wp])
      do i = 1, steps
         call point%pull(2, 0.01_wp*real(i, wp)/real(steps, wp), 0.0_wp)
      end do
      call check(point%history(matrix_finish)/point%history(matrix_onset), 1.05_wp, 1.0e-9_wp, &
         & "leave the ratio asked for")
      call check(point%history(matrix_energy)*1.5_wp/0.22_wp, 1.0_wp, 1.0e-6_wp, &
         & "and the toughness right")
      point = new_point(ply, [6.0_wp, 0.25_wp])
      call point%pull(1, 0.02_wp, 0.0_wp)
      call check(point%history(fibre_onset)*153.0e3_wp, &
         & sqrt(2.0_wp*153.0e3_wp*91.6_wp/(6.0_wp*1.05_wp)), 1.0e-6_wp, "hold for fibres as well")
   end subroutine test_reduced_strengths

   !> Stress at the onset that a straight path meets; equivalent stress of a matrix mode
   real(wp) function strength(ply, length, path)
      type(ply_constants_type), intent(in) :: ply
      real(wp), intent(in) :: length
      !> Strain across the fibres and shear strain, well beyond onset
      real(wp), intent(in) :: path(2)

      type(point_type) :: point

      point = new_point(ply, [0.1_wp, length])
      call point%pull(2, 1.0e-9_wp*path(1), 1.0e-9_wp*path(2))
      call point%pull(2, path(1), path(2))
      strength = abs(point%history(matrix_onset)) &
         & *merge(ply%young(2), ply%shear(1), abs(path(1)) > 0.0_wp)
   end function strength

   !> As it is: the stress drops at the strength; in shear, where no lateral strain follows the drop
   subroutine test_drop()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: onset
      integer :: i

      call begin("drop")
      ply = paper_ply()
      ply%snap_back = snap_drop
      onset = ply%shear_strength/ply%shear(1)
      point = new_point(ply, [1.0_wp, 1.5_wp])
      call point%pull(2, 0.0_wp, onset*(1.0_wp - 1.0e-9_wp))
      call check(point%stress(4), ply%shear_strength, 1.0e-6_wp, "keeps the strength")
      call point%pull(2, 0.0_wp, onset*(1.0_wp + 1.0e-5_wp))
      call check(damage(point), 1.0_wp, 0.0_wp, "is broken right behind it")
      do i = 1, 10
         call point%pull(2, 0.0_wp, onset*(1.0_wp + 0.1_wp*real(i, wp)))
      end do
      call check(point%dissipated(), 0.5_wp*ply%shear_strength*onset, &
         & 1.0e-5_wp*point%dissipated(), "dissipates all that was stored")
      call check(point%dissipated() > ply%matrix_toughness(1)/1.5_wp, "more than the toughness")
   end subroutine test_drop

   !> Onset in compression by Hashin: shear of 1.64 S12 at -105 MPa
   subroutine test_hashin()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: across, borne

      call begin("Hashin's onset")
      ply = paper_ply()
      ply%onset = onset_hashin
      across = -105.0_wp
      borne = 90.0_wp*sqrt(1.0_wp - (across/80.0_wp)**2 &
         & - ((236.0_wp/80.0_wp)**2 - 1.0_wp)*across/236.0_wp)
      call check(borne/90.0_wp, 1.64_wp, 0.005_wp, "is that of an independent program")
      point = new_point(ply, [0.1_wp, 0.01_wp])
      call point%pull(2, across/10.3e3_wp, borne/6.0e3_wp*(1.0_wp - 1.0e-9_wp))
      call check(damage(point), 0.0_wp, 0.0_wp, "bears that shear")
      call point%pull(2, across/10.3e3_wp, borne/6.0e3_wp*(1.0_wp + 1.0e-6_wp))
      call check(damage(point) > 0.0_wp, "and no more")
      point = new_point(ply, [0.1_wp, 0.01_wp])
      call point%pull(2, 1.2_wp*across/10.3e3_wp, 1.2_wp*borne/6.0e3_wp)
      call check(onset_value(point), 1.0_wp, 1.0e-9_wp, "is met by the state kept after a big step")
      point = new_point(ply, [0.1_wp, 0.01_wp])
      call point%pull(2, -1.1_wp*236.0_wp/10.3e3_wp, 0.0_wp)
      call check(point%history(matrix_onset), -236.0_wp/10.3e3_wp, 1.0e-9_wp, &
         & "is at YC without shear")
   end subroutine test_hashin

   !> Hashin's criterion at the onset that the point has kept, on the ray of its strain
   real(wp) function onset_value(point)
      type(point_type), intent(in) :: point

      real(wp) :: across, scale, shear

      scale = abs(point%history(matrix_onset))/norm2(point%strain([2, 4]))
      across = scale*point%strain(2)*10.3e3_wp
      shear = scale*point%strain(4)*6.0e3_wp
      onset_value = (across/80.0_wp)**2 + ((236.0_wp/80.0_wp)**2 - 1.0_wp)*across/236.0_wp &
         & + (shear/90.0_wp)**2
   end function onset_value

   !> The larger of the two damages of a point
   pure real(wp) function damage(point)
      type(point_type), intent(in) :: point

      damage = max(point%history(fibre_damage), point%history(matrix_damage))
   end function damage

end program test_law_ply_damage_onset
