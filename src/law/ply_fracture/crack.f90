!> Crack of the matrix on its plane of fracture: onset, growth of the cracked share of the plane,
!> and what the faces of the cracked share do.
!>
!> The plane is an intact and a cracked share at the same strain (as Alfano and Sacco, 2006, have it
!> for interfaces). The cracked share has a strain of its own, its slip: opened, it is free of
!> traction; closed, it bears pressure and slides under Coulomb's friction.
module plydyn_law_ply_fracture_crack
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_fracture_constants, only : fracture_batch_type
   use plydyn_law_ply_fracture_fibres, only : fibres_type
   use plydyn_law_ply_fracture_history, only : held_opening, histories, matrix_damage, &
      & matrix_width, plane_cosine, plane_sine, slip
   use plydyn_law_ply_fracture_plane, only : exposure_bound, find_plane, find_stiffness, &
      & plane_exposure, plane_stiffness_type, plane_traction, refine_plane
   implicit none
   private

   public :: crack_matrix, crack_strain

   !> Crack after a step
   type, public :: crack_type
      !> Whether any lane has a plane of fracture; 1 in lanes that do, else 0
      logical :: any = .false.
      real(wp) :: has(lanes)
      !> Of the angle of the plane; that of the plane 1-3 without one
      real(wp) :: cosine(lanes), sine(lanes)
      !> Cracked share; its slip, and the traction on it
      real(wp) :: damage(lanes), slip(lanes, 3), contact(lanes, 3)
      !> Traction on the plane were it whole; stiffness of the plane
      real(wp) :: whole(lanes, 3)
      type(plane_stiffness_type) :: stiffness
      !> Opening that debris holds
      real(wp) :: held(lanes)
   end type crack_type

   !> Square of the exposures below which no plane is looked for; 1 less room for round-off
   real(wp), parameter :: far_limit = 0.99_wp
   !> Exposure of the best plane tried below which no plane reaches 1: none is farther than 7.5
   !> degrees from one tried, which is 1 - cos(15 degrees) of the shear over its strength, and that
   !> is less than 4.4
   real(wp), parameter :: coarse_limit = 0.85_wp
   !> Keeps divisors off zero in lanes without tractions
   real(wp), parameter :: small = 1.0e-30_wp

contains

   !> Crack after a step
   pure subroutine crack_matrix(ply, stress, fibres, h, crack)
      type(fracture_batch_type), intent(in) :: ply
      !> Stress of the ply without a crack
      real(wp), intent(in) :: stress(lanes, 6)
      !> What is left of the fibres
      type(fibres_type), intent(in) :: fibres
      !> History of the point
      real(wp), intent(in) :: h(lanes, histories)
      type(crack_type), intent(out) :: crack

      real(wp) :: bound, energy(lanes), most, strength(lanes)
      integer :: l

      crack%sine(:) = h(:, plane_sine)
      crack%has(:) = merge(1.0_wp, 0.0_wp, abs(h(:, plane_cosine)) + abs(crack%sine) > 0.0_wp)
      crack%cosine(:) = h(:, plane_cosine) + (1.0_wp - crack%has)
      crack%damage(:) = h(:, matrix_damage)
      crack%held(:) = h(:, held_opening)
      crack%slip(:, :) = h(:, slip:slip + 2)
      crack%any = any(crack%has > 0.0_wp)
      if (.not. all(crack%has > 0.0_wp)) then
         call exposure_bound(ply, stress, fibres, strength, energy)
         most = 0.0_wp
         !$omp simd private(bound) reduction(max:most)
         do l = 1, lanes
            bound = max(strength(l), h(l, matrix_width)*energy(l))
            most = max(most, (1.0_wp - crack%has(l))*bound)
         end do
         if (most >= far_limit) call begin_crack(ply, stress, fibres, h, crack)
      end if
      if (.not. crack%any) return
      call find_stiffness(ply, crack%cosine, crack%sine, fibres, crack%stiffness)
      call plane_traction(crack%cosine, crack%sine, stress, crack%whole)
      call grow(ply, h(:, matrix_width), crack)
      call slide(ply, crack)
   end subroutine crack_matrix

   !> Give a plane to the lanes whose most exposed plane cracks
   pure subroutine begin_crack(ply, stress, fibres, h, crack)
      type(fracture_batch_type), intent(in) :: ply
      real(wp), intent(in) :: stress(lanes, 6), h(lanes, histories)
      type(fibres_type), intent(in) :: fibres
      type(crack_type), intent(inout) :: crack

      real(wp) :: cosine(lanes), driver(lanes), exposure(lanes), sine(lanes)
      integer :: l

      call find_plane(ply, stress, cosine, sine, exposure)
      call drive_plane(ply, cosine, sine, stress, fibres, h(:, matrix_width), driver)
      if (maxval(driver*(1.0_wp - crack%has)) < coarse_limit) return
      call refine_plane(ply, stress, cosine, sine, exposure)
      call drive_plane(ply, cosine, sine, stress, fibres, h(:, matrix_width), driver)
      do l = 1, lanes
         if (driver(l) < 1.0_wp .or. max(crack%has(l), 1.0_wp - ply%own(l)) > 0.0_wp) cycle
         crack%any = .true.
         crack%has(l) = 1.0_wp
         crack%cosine(l) = cosine(l)
         crack%sine(l) = sine(l)
      end do
   end subroutine begin_crack

   !> What would make a crack grow on some plane
   pure subroutine drive_plane(ply, cosine, sine, stress, fibres, width, driver)
      type(fracture_batch_type), intent(in) :: ply
      !> Of the angle of the plane
      real(wp), intent(in) :: cosine(lanes), sine(lanes)
      real(wp), intent(in) :: stress(lanes, 6)
      type(fibres_type), intent(in) :: fibres
      !> Width of the crack band
      real(wp), intent(in) :: width(lanes)
      !> Exposure, 1 at onset
      real(wp), intent(out) :: driver(lanes)

      real(wp) :: energy(lanes), shared(lanes), softening(lanes), traction(lanes, 3)
      type(plane_stiffness_type) :: stiffness

      call find_stiffness(ply, cosine, sine, fibres, stiffness)
      call plane_traction(cosine, sine, stress, traction)
      call plane_exposure(ply, traction, driver)
      call find_energy(ply, traction, stiffness, energy, shared)
      call drive(ply, width, energy, shared, driver, softening)
   end subroutine drive_plane

   !> Let the cracked share grow; it never heals
   pure subroutine grow(ply, width, crack)
      type(fracture_batch_type), intent(in) :: ply
      !> Width of the crack band
      real(wp), intent(in) :: width(lanes)
      type(crack_type), intent(inout) :: crack

      real(wp) :: damage(lanes), driver(lanes), energy(lanes), shared(lanes), softening(lanes)

      call plane_exposure(ply, crack%whole, driver)
      if (.not. can_grow(ply, width, driver, crack)) return
      call find_energy(ply, crack%whole, crack%stiffness, energy, shared)
      call drive(ply, width, energy, shared, driver, softening)
      driver(:) = max(driver, 1.0_wp)
      damage(:) = crack%has*min(damage_at(driver, softening), ply%most_damage)
      crack%damage(:) = max(damage, crack%damage)
   end subroutine grow

   !> Whether damage might grow in any lane: by the least toughness, and as if nothing rubbed.
   !> Damage is beyond d where driver**2*(1 - d) - driver + d*driver**2/softening is above 0
   pure logical function can_grow(ply, width, exposure, crack)
      type(fracture_batch_type), intent(in) :: ply
      !> Width of the crack band; exposure of the plane by strength
      real(wp), intent(in) :: width(lanes), exposure(lanes)
      type(crack_type), intent(in) :: crack

      real(wp) :: ahead, driver, most, spent
      integer :: l

      most = 0.0_wp
      associate (t => crack%whole, plane => crack%stiffness, d => crack%damage)
         !$omp simd private(ahead, driver, spent) reduction(max:most)
         do l = 1, lanes
            spent = 0.5_wp*width(l)*ply%least_give(l)*(t(l, 2)**2*plane%give_across(l) &
               & + t(l, 3)**2*plane%give_along(l) + max(t(l, 1) - plane%ratio(l)*t(l, 2), &
               & 0.0_wp)**2*plane%give_normal(l))
            driver = max(exposure(l), sqrt(ply%least_ratio(l)*spent))
            ahead = driver*(driver*(1.0_wp - d(l)) - 1.0_wp) + d(l)*spent
            ahead = min(ahead, ply%most_damage(l) - d(l))
            most = max(most, crack%has(l)*ahead)
         end do
      end associate
      can_grow = most > 0.0_wp
   end function can_grow

   !> Share of a plane that has cracked
   elemental real(wp) function damage_at(driver, softening) result(damage)
      !> Tractions over those of onset, 1 or more
      real(wp), intent(in) :: driver
      !> Ratio of tractions at the end of softening to those of onset
      real(wp), intent(in) :: softening

      damage = (driver - 1.0_wp)*softening/(driver*max(softening - 1.0_wp, small))
   end function damage_at

   !> What makes a crack grow: the tractions of a whole plane over those of onset on the same ray,
   !> and over them those at which nothing is left. Where the band is too wide for the toughness,
   !> onset is early
   pure subroutine drive(ply, width, energy, shared, driver, softening)
      type(fracture_batch_type), intent(in) :: ply
      !> Width of the crack band
      real(wp), intent(in) :: width(lanes)
      !> As from `find_energy`
      real(wp), intent(in) :: energy(lanes), shared(lanes)
      !> Exposure by strength in; 1 at onset
      real(wp), intent(inout) :: driver(lanes)
      !> Ratio of tractions at the end of softening to those of onset
      real(wp), intent(out) :: softening(lanes)

      real(wp) :: spent, toughness
      integer :: l

      do l = 1, lanes
         toughness = ply%toughness(l, 1) + (ply%toughness(l, 2) - ply%toughness(l, 1)) &
            & *shared(l)**ply%mode_exponent(l)
         ! energy of the band at the traction of now over the toughness
         spent = max(0.5_wp*width(l)*energy(l)/toughness, small)
         driver(l) = max(driver(l), sqrt(ply%least_ratio(l)*spent))
         softening(l) = driver(l)**2/spent
      end do
   end subroutine drive

   !> Twice the energy per volume that a plane releases when it cracks, and the part of it that is
   !> of shear. Of a closed plane it is that of the shear beyond friction
   pure subroutine find_energy(ply, traction, stiffness, energy, shared)
      type(fracture_batch_type), intent(in) :: ply
      real(wp), intent(in) :: traction(lanes, 3)
      type(plane_stiffness_type), intent(in) :: stiffness
      real(wp), intent(out) :: energy(lanes), shared(lanes)

      real(wp) :: beyond, normal, opened, sheared, size
      integer :: l

      associate (t => traction, plane => stiffness)
         !$omp simd private(beyond, normal, opened, sheared, size)
         do l = 1, lanes
            sheared = t(l, 2)**2*plane%give_across(l) + t(l, 3)**2*plane%give_along(l)
            ! normal traction on faces that have slid without friction: what opens or presses them
            normal = t(l, 1) - plane%ratio(l)*t(l, 2)
            opened = max(normal, 0.0_wp)**2*plane%give_normal(l)
            size = max(sqrt(t(l, 2)**2 + t(l, 3)**2), small)
            beyond = max(size + ply%friction(l)*min(normal, 0.0_wp), 0.0_wp)/size
            energy(l) = beyond**2*sheared + opened
            shared(l) = (sheared + small)/(sheared + opened + small)
         end do
      end associate
   end subroutine find_energy

   !> Slip of the cracked share, and the traction on it. Debris holds a share of the largest opening
   pure subroutine slide(ply, crack)
      type(fracture_batch_type), intent(in) :: ply
      type(crack_type), intent(inout) :: crack

      real(wp) :: across, along, closed, held, kept, opening, pressure, shift
      integer :: l

      associate (t => crack%whole, plane => crack%stiffness, g => crack%slip)
         !$omp simd private(across, along, closed, held, kept, opening, pressure, shift)
         do l = 1, lanes
            opening = (t(l, 1) - plane%ratio(l)*t(l, 2))*plane%give_normal(l)
            held = crack%held(l)
            closed = merge(1.0_wp, 0.0_wp, opening <= held)
            held = max(held, (1.0_wp - closed)*min(ply%debris_share(l)*opening, &
               & ply%debris_limit(l)))
            opening = max(opening, held)
            ! traction on the share if it stuck, and what friction bears of it
            shift = t(l, 2) - plane%both(l)*opening
            across = shift - plane%across(l)*g(l, 2)
            along = t(l, 3) - plane%along(l)*g(l, 3)
            pressure = plane%normal(l)*opening + plane%both(l)*g(l, 2) - t(l, 1)
            kept = ply%friction(l)*max(pressure, 0.0_wp)
            kept = closed*min(kept/max(sqrt(across**2 + along**2), kept, small), 1.0_wp)
            crack%held(l) = held
            g(l, 1) = opening
            g(l, 2) = (shift - kept*across)*plane%give_across(l)
            g(l, 3) = (t(l, 3) - kept*along)*plane%give_along(l)
            crack%contact(l, 1) = closed*(t(l, 1) - plane%normal(l)*opening &
               & - plane%both(l)*g(l, 2))
            crack%contact(l, 2) = kept*across
            crack%contact(l, 3) = kept*along
         end do
      end associate
   end subroutine slide

   !> Strain of the ply that is the crack's: slip of the cracked share
   pure subroutine crack_strain(crack, strain)
      type(crack_type), intent(in) :: crack
      !> In ply axes
      real(wp), intent(out) :: strain(lanes, 6)

      real(wp) :: c, g1, g2, g3, s
      integer :: l

      !$omp simd private(c, g1, g2, g3, s)
      do l = 1, lanes
         c = crack%cosine(l)
         s = crack%sine(l)
         g1 = crack%damage(l)*crack%slip(l, 1)
         g2 = crack%damage(l)*crack%slip(l, 2)
         g3 = crack%damage(l)*crack%slip(l, 3)
         strain(l, 1) = 0.0_wp
         strain(l, 2) = c*(c*g1 - s*g2)
         strain(l, 3) = s*(s*g1 + c*g2)
         strain(l, 4) = c*g3
         strain(l, 5) = s*g3
         strain(l, 6) = 2.0_wp*c*s*g1 + (c*c - s*s)*g2
      end do
   end subroutine crack_strain

end module plydyn_law_ply_fracture_crack
