!> How long an impactor will touch the plate, estimated before the run.
!>
!> A mass that leaves a spring again has touched it for half a period. The spring is the laminate
!> over the rectangle between its supports, simply supported and loaded by a point force: Navier's
!> double series, or a beam where two opposite sides alone are supported. With large displacement
!> the membrane of a plate adds a cubic term, that of von Karman's equations for one half wave along
!> each side, whose edges stay straight and are free to come closer: the mass is a Duffing
!> oscillator. Clamped edges make the contact shorter, damage longer.
module plydyn_domain_contact_duration
   use plydyn_base_matrix, only : invert
   use plydyn_base_precision, only : wp
   use plydyn_domain_sheet, only : sheet_of, sheet_type
   use plydyn_model_control, only : total_lagrangian
   use plydyn_model_approach, only : approach_type, find_approach
   use plydyn_model_body, only : contact_type
   use plydyn_model_model, only : model_type
   use plydyn_model_symmetry, only : copies
   implicit none
   private

   public :: estimate_contact, half_period, membrane_stiffness, plate_stiffness

   real(wp), parameter :: pi = acos(-1.0_wp)
   !> Half waves along each side that are summed
   integer, parameter :: waves = 100
   !> Points of the integral over half a period, whose error falls with their power
   integer, parameter :: phases = 64
   !> Supports are looked for along x and y, within this distance sideways over that to them
   real(wp), parameter :: slope = 0.25_wp

   !> An estimate
   type, public :: contact_duration_type
      !> Whether there is one
      logical :: is_known = .false.
      !> Times of the first touch and of the contact
      real(wp) :: start = 0.0_wp, duration = 0.0_wp
      !> Distances between the supports along x and y, 0 where there are none
      real(wp) :: span(2) = 0.0_wp
   end type contact_duration_type

contains

   !> Estimate the contact of an impactor that flies freely, and has more mass than the plate
   !> between its supports: a lighter one leaves before the plate comes back
   subroutine estimate_contact(model, contact, found)
      !> The model, with its planes of symmetry
      type(model_type), intent(in) :: model
      !> The impactor and the face
      type(contact_type), intent(in) :: contact
      type(contact_duration_type), intent(out) :: found

      type(approach_type) :: approach
      type(sheet_type) :: sheet
      real(wp) :: arm(2, 2), cubic, energy, mass, width(2)
      integer :: axis

      if (contact%impactor == 0 .or. size(model%parts) == 0) return
      sheet = sheet_of(model, 1)
      approach = find_approach(model, contact)
      if (.not. (sheet%bends .and. approach%is_known .and. approach%arrives)) return
      call find_arms(model, contact, approach%centre(:2), arm)
      width(:) = maxval(model%mesh%position(:2, :), dim=2) &
         & - minval(model%mesh%position(:2, :), dim=2)
      where (model%planes /= 0) width = 2.0_wp*width
      do axis = 1, 2
         if (maxval(arm(:, axis)) < huge(1.0_wp)) found%span(axis) = sum(arm(:, axis))
      end do
      mass = copies(model)*model%impactors(contact%impactor)%mass
      found%is_known = any(found%span > 0.0_wp) .and. minval(arm) > sheet%thickness &
         & .and. mass > sheet%mass*product(merge(found%span, width, found%span > 0.0_wp))
      if (.not. found%is_known) return
      found%start = approach%time
      cubic = 0.0_wp
      if (model%control%kinematics == total_lagrangian .and. minval(found%span) > 0.0_wp) then
         cubic = membrane_stiffness(sheet%a, found%span)
      end if
      associate (own => model%impactors(contact%impactor))
         energy = 0.5_wp*mass*(own%velocity(3) + approach%time*own%gravity(3))**2
      end associate
      found%duration = half_period(mass, plate_stiffness(sheet%d, arm, width), cubic, energy)
   end subroutine estimate_contact

   !> Distances from a place to the next supports along x and y, huge where there are none
   pure subroutine find_arms(model, contact, place, arm)
      type(model_type), intent(in) :: model
      type(contact_type), intent(in) :: contact
      !> In the plane, length
      real(wp), intent(in) :: place(2)
      !> On the low and the high side, along x and y, length
      real(wp), intent(out) :: arm(2, 2)

      logical, allocatable :: holds(:)
      real(wp) :: way(2)
      integer :: axis, i, side

      holds = supporting_nodes(model, contact%face)
      arm(:, :) = huge(1.0_wp)
      do i = 1, size(holds)
         if (.not. holds(i)) cycle
         way(:) = model%mesh%position(:2, i) - place
         do axis = 1, 2
            if (abs(way(3 - axis)) > slope*abs(way(axis))) cycle
            side = merge(1, 2, way(axis) < 0.0_wp)
            arm(side, axis) = min(arm(side, axis), abs(way(axis)))
         end do
      end do
      do axis = 1, 2
         if (model%planes(axis) /= 0) arm(:, axis) = minval(arm(:, axis))
      end do
   end subroutine find_arms

   !> Nodes that are held along z, or have a fixture behind them
   pure function supporting_nodes(model, face) result(holds)
      type(model_type), intent(in) :: model
      !> The face that the impactor touches
      integer, intent(in) :: face
      logical, allocatable :: holds(:)

      integer :: i, k

      allocate (holds(size(model%mesh%node_id)), source=.false.)
      do k = 1, size(model%supports)
         if (model%supports(k)%direction(3)) holds(model%supports(k)%nodes) = .true.
      end do
      do k = 1, size(model%motions)
         if (model%motions(k)%direction == 3) holds(model%motions(k)%nodes) = .true.
      end do
      do k = 1, size(model%fixtures)
         if (model%fixtures(k)%face == face) cycle
         do i = 1, size(holds)
            holds(i) = holds(i) .or. model%fixtures(k)%body%covers(model%mesh%position(:2, i))
         end do
      end do
   end function supporting_nodes

   !> Point force over its displacement, of a plate or beam without shear deformation
   pure real(wp) function plate_stiffness(d, arm, width) result(stiffness)
      !> Stiffness in bending without strain of the mid-plane; its coupling of bending and twisting
      !> is left out
      real(wp), intent(in) :: d(3, 3)
      !> Distances of the force from the supports, (2, along x and y), length; huge for none
      real(wp), intent(in) :: arm(2, 2)
      !> Sides of the plate, length
      real(wp), intent(in) :: width(2)

      real(wp) :: flexibility(3, 3), span(2), squares(2), sum_of, unused
      integer :: axis, m, n

      do axis = 1, 2
         if (maxval(arm(:, axis)) < huge(1.0_wp)) cycle
         ! a beam across the axis without supports
         call invert(d, flexibility, unused)
         stiffness = 3.0_wp*width(axis)*sum(arm(:, 3 - axis)) &
            & /(flexibility(3 - axis, 3 - axis)*product(arm(:, 3 - axis))**2)
         return
      end do
      span(:) = arm(1, :) + arm(2, :)
      sum_of = 0.0_wp
      do m = 1, waves
         do n = 1, waves
            squares(:) = ([m, n]/span)**2
            sum_of = sum_of + product(sin([m, n]*pi*arm(1, :)/span)**2) &
               & /(d(1, 1)*squares(1)**2 + 2.0_wp*(d(1, 2) + 2.0_wp*d(3, 3))*product(squares) &
               & + d(2, 2)*squares(2)**2)
         end do
      end do
      stiffness = pi**4*product(span)/(4.0_wp*sum_of)
   end function plate_stiffness

   !> Cubic term of the force of a simply supported rectangle over its displacement in the middle
   pure real(wp) function membrane_stiffness(a, span) result(cubic)
      !> Stiffness in the plane; sides along x and y, length
      real(wp), intent(in) :: a(3, 3), span(2)

      real(wp) :: flexibility(3, 3), unused

      call invert(a, flexibility, unused)
      cubic = pi**4*product(span)/64.0_wp*(1.0_wp/(flexibility(1, 1)*span(1)**4) &
         & + 1.0_wp/(flexibility(2, 2)*span(2)**4))
   end function membrane_stiffness

   !> Half a period of a mass on a spring with a linear and a cubic term
   pure real(wp) function half_period(mass, linear, cubic, energy) result(time)
      real(wp), intent(in) :: mass
      !> Force over displacement, and over its third power
      real(wp), intent(in) :: linear, cubic
      !> Kinetic energy of the mass where the spring has no force
      real(wp), intent(in) :: energy

      real(wp) :: phase, square
      integer :: i

      ! square of the amplitude
      square = 4.0_wp*energy/(linear + sqrt(linear**2 + 4.0_wp*cubic*energy))
      time = 0.0_wp
      do i = 1, phases
         phase = pi*(i - 0.5_wp)/phases
         time = time + pi/phases*sqrt(mass/(linear + 0.5_wp*cubic*square*(1.0_wp &
            & + sin(phase)**2)))
      end do
   end function half_period

end module plydyn_domain_contact_duration
