!> Planes through the fibres on which the matrix cracks: tractions, exposure, and the plane of most
!> exposure.
!>
!> A plane is known by the cosine and sine of the angle of its normal from the axis 2 towards 3.
!> Tractions are normal to it, tangential across the fibres, and along them.
module plydyn_law_ply_fracture_plane
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_fibres, only : fibres_type
   implicit none
   private

   public :: exposure_bound, find_plane, find_stiffness, plane_exposure, plane_traction, &
      & refine_plane

   !> Stiffness of a plane against slip
   type, public :: plane_stiffness_type
      !> Of opening, of sliding across the fibres and along them, and between the first two
      real(wp) :: normal(lanes), across(lanes), along(lanes), both(lanes)
      !> Slip by a traction along the fibres; by one across them where the plane does not open, and
      !> by one normal where it slides freely; `both` over `across`
      real(wp) :: give_along(lanes), give_across(lanes), give_normal(lanes), ratio(lanes)
   end type plane_stiffness_type

   !> Angles that are tried, over half a turn, and halvings of their distance that follow
   integer, parameter :: trials = 12, halvings = 18
   real(wp), parameter :: half_turn = acos(-1.0_wp)
   integer :: i_
   real(wp), parameter :: trial_cosine(trials) = [(cos(half_turn*real(i_, wp)/trials), &
      & i_=0, trials - 1)]
   real(wp), parameter :: trial_sine(trials) = [(sin(half_turn*real(i_, wp)/trials), &
      & i_=0, trials - 1)]
   real(wp), parameter :: turn_cosine(halvings) = [(cos(half_turn/trials*0.5_wp**i_), &
      & i_=1, halvings)]
   real(wp), parameter :: turn_sine(halvings) = [(sin(half_turn/trials*0.5_wp**i_), &
      & i_=1, halvings)]

contains

   !> Tractions on a plane: normal, tangential across the fibres, along them
   pure subroutine plane_traction(cosine, sine, stress, traction)
      !> Of the angle of the plane
      real(wp), intent(in) :: cosine(lanes), sine(lanes)
      !> Stress in ply axes
      real(wp), intent(in) :: stress(lanes, 6)
      !> (lanes, 3)
      real(wp), intent(out) :: traction(lanes, 3)

      real(wp) :: c, s
      integer :: l

      !$omp simd private(c, s)
      do l = 1, lanes
         c = cosine(l)
         s = sine(l)
         traction(l, 1) = stress(l, 2)*c*c + stress(l, 3)*s*s + 2.0_wp*stress(l, 6)*s*c
         traction(l, 2) = (stress(l, 3) - stress(l, 2))*s*c + stress(l, 6)*(c*c - s*s)
         traction(l, 3) = stress(l, 4)*c + stress(l, 5)*s
      end do
   end subroutine plane_traction

   !> Stiffness of a plane against slip across it
   pure subroutine find_stiffness(ply, cosine, sine, fibres, plane)
      type(fracture_batch_type), intent(in) :: ply
      !> Of the angle of the plane
      real(wp), intent(in) :: cosine(lanes), sine(lanes)
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> The stiffness
      type(plane_stiffness_type), intent(out) :: plane

      real(wp) :: c22, c23, c33, cc, cs, difference, lost, ss
      integer :: l

      associate (c => ply%stiffness, g => ply%shear)
         !$omp simd private(c22, c23, c33, cc, cs, difference, lost, ss)
         do l = 1, lanes
            lost = fibres%lost(l)
            c22 = c(l, 4) - lost*c(l, 2)**2
            c23 = c(l, 5) - lost*c(l, 2)*c(l, 3)
            c33 = c(l, 6) - lost*c(l, 3)**2
            cc = cosine(l)**2
            ss = sine(l)**2
            cs = cosine(l)*sine(l)
            difference = cc - ss
            plane%normal(l) = c22*cc**2 + c33*ss**2 + (2.0_wp*c23 + 4.0_wp*g(l, 3))*cs**2
            plane%across(l) = (c22 + c33 - 2.0_wp*c23)*cs**2 + g(l, 3)*difference**2
            plane%along(l) = fibres%sheared(l)*(g(l, 1)*cc + g(l, 2)*ss)
            plane%both(l) = cs*(c33*ss - c22*cc + (c23 + 2.0_wp*g(l, 3))*difference)
            plane%give_across(l) = 1.0_wp/plane%across(l)
            plane%give_along(l) = 1.0_wp/plane%along(l)
            plane%ratio(l) = plane%both(l)*plane%give_across(l)
            plane%give_normal(l) = 1.0_wp/(plane%normal(l) - plane%both(l)*plane%ratio(l))
         end do
      end associate
   end subroutine find_stiffness

   !> Exposure of a plane: the tractions over those on the same ray at which it cracks. Opened
   !> planes crack as Catalanotti, Camanho and Marques (2013, eq. 42) have it for tractions normal
   !> and tangential, with the quadratic sum of Hashin (1980) for shear along the fibres; on closed
   !> planes pressure adds to the strengths (their eq. 5; Puck and Schuermann, 1998)
   pure subroutine plane_exposure(ply, traction, exposure)
      type(fracture_batch_type), intent(in) :: ply
      !> Normal, tangential, along the fibres
      real(wp), intent(in) :: traction(lanes, 3)
      !> 1 where the plane cracks
      real(wp), intent(out) :: exposure(lanes)

      real(wp) :: across, along, closed, is_open, normal, opened, size, slope
      integer :: l

      !$omp simd private(across, along, closed, is_open, normal, opened, size, slope)
      do l = 1, lanes
         normal = traction(l, 1)
         across = (traction(l, 2)*ply%across(l))**2
         along = (traction(l, 3)*ply%along(l))**2
         slope = ply%normal_slope(l)*normal
         size = slope + sqrt((normal*ply%across(l))**2 + across + slope**2)
         opened = sqrt(size**2 + along)
         closed = max(sqrt(across + along) + ply%gain(l)*normal, 0.0_wp)
         is_open = merge(1.0_wp, 0.0_wp, normal > 0.0_wp)
         exposure(l) = is_open*opened + (1.0_wp - is_open)*closed
      end do
   end subroutine plane_exposure

   !> Squares that no exposure of any plane exceeds: of its strength, and of the toughness of a
   !> crack band of width 1 (see `drive` of `crack.f90`)
   pure subroutine exposure_bound(ply, stress, fibres, strength, energy)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress in ply axes
      real(wp), intent(in) :: stress(lanes, 6)
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> Squares of exposures
      real(wp), intent(out) :: strength(lanes), energy(lanes)

      real(wp) :: across, along, radius
      integer :: l

      !$omp simd private(across, along, radius)
      do l = 1, lanes
         ! square of the largest shear across the fibres, and with it that of the largest tension
         radius = (0.5_wp*(stress(l, 2) - stress(l, 3)))**2 + stress(l, 6)**2
         across = radius + max(0.5_wp*(stress(l, 2) + stress(l, 3)) + sqrt(radius), 0.0_wp)**2
         along = stress(l, 4)**2 + stress(l, 5)**2
         strength(l) = ply%far_matrix(l, 1)*across + ply%far_matrix(l, 2)*along
         energy(l) = ply%far_matrix(l, 3)*(across + along/fibres%sheared(l))
      end do
   end subroutine exposure_bound

   !> The most exposed of some planes
   pure subroutine find_plane(ply, stress, cosine, sine, exposure)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress in ply axes
      real(wp), intent(in) :: stress(lanes, 6)
      !> Of its angle, from -90 to 90 degrees; its exposure
      real(wp), intent(out) :: cosine(lanes), sine(lanes), exposure(lanes)

      real(wp) :: plane(lanes, 2)
      integer :: i

      exposure(:) = -1.0_wp
      cosine(:) = 1.0_wp
      sine(:) = 0.0_wp
      do i = 1, trials
         plane(:, 1) = trial_cosine(i)
         plane(:, 2) = trial_sine(i)
         call try_plane(ply, stress, plane, cosine, sine, exposure)
      end do
      sine(:) = sign(1.0_wp, cosine)*sine
      cosine(:) = abs(cosine)
   end subroutine find_plane

   !> The plane of most exposure, from the best that `find_plane` has tried: halvings of the
   !> distance to its neighbours, to a millionth of a turn
   pure subroutine refine_plane(ply, stress, cosine, sine, exposure)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress in ply axes
      real(wp), intent(in) :: stress(lanes, 6)
      !> As in `find_plane`
      real(wp), intent(inout) :: cosine(lanes), sine(lanes), exposure(lanes)

      real(wp) :: plane(lanes, 2)
      integer :: i, k

      do i = 1, halvings
         do k = -1, 1, 2
            plane(:, 1) = turn_cosine(i)*cosine - k*turn_sine(i)*sine
            plane(:, 2) = turn_cosine(i)*sine + k*turn_sine(i)*cosine
            call try_plane(ply, stress, plane, cosine, sine, exposure)
         end do
      end do
      sine(:) = sign(1.0_wp, cosine)*sine
      cosine(:) = abs(cosine)
   end subroutine refine_plane

   !> Keep a plane where it is more exposed than the best so far
   pure subroutine try_plane(ply, stress, plane, cosine, sine, exposure)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress in ply axes; cosine and sine of the angle of the plane
      real(wp), intent(in) :: stress(lanes, 6), plane(lanes, 2)
      !> The best so far, and its exposure
      real(wp), intent(inout) :: cosine(lanes), sine(lanes), exposure(lanes)

      real(wp) :: best, c, found(lanes), s, this, traction(lanes, 3)
      integer :: l

      call plane_traction(plane(:, 1), plane(:, 2), stress, traction)
      call plane_exposure(ply, traction, found)
      !$omp simd private(best, c, s, this)
      do l = 1, lanes
         this = found(l)
         best = exposure(l)
         c = cosine(l)
         s = sine(l)
         cosine(l) = merge(plane(l, 1), c, this > best)
         sine(l) = merge(plane(l, 2), s, this > best)
         exposure(l) = max(this, best)
      end do
   end subroutine try_plane

end module plydyn_law_ply_fracture_plane
