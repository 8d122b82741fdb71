!> A crack of the matrix across a ply: tied until the tractions on it reach the strengths, then a
!> cohesive law that begins at those very tractions, with contact and friction of closed faces.
!>
!> The lanes are plies, and a crack has the bottom and the top of its ply. Tractions and openings
!> are in the axes of the ply: along the fibres, across the crack, and along the thickness. At the
!> start faces that have not moved carry the tractions of the tie, as if they had opened by these
!> over the stiffness. From there on one damage for both faces leads the tractions down to zero on a
!> line, over the root of the mean square of both openings: whether the ply is stretched or bent,
!> and however its faces move, softening takes the toughness.
!> Where faces are pressed together they meet with the same stiffness. It falls with their mean slip
!> along the thickness, and ends for good when that has reached half of the ply: faces that have
!> slid past each other do not meet again. Debris between the faces lets them meet earlier: it holds
!> the largest opening that there has been, up to a limit (after Bouvet and others, 2012).
module plydyn_law_matrix_crack
   use plydyn_base_precision, only : lanes, wp
   implicit none
   private

   public :: begin_crack, crack_energy, exceeds, update_crack

   !> Faces of a ply; axes of a crack
   integer, parameter, public :: crack_faces = 2, along = 1, across = 2, upward = 3

   !> History variables of a crack: time of the start; size of the opening at the start and at the
   !> end; damage; 1 where faces have slid past each other; share of shear at the start; energies
   !> lost per area by opening and by friction; then the openings at the start, the slips, the
   !> openings that debris holds, and the tractions of friction, face by face
   integer, parameter, public :: time_at = 1, onset_at = 2, final_at = 3, damage_at = 4, &
      & apart_at = 5, mode_at = 6, fracture_at = 7, friction_at = 8, start_at = 8, slip_at = 14, &
      & held_at = 18, traction_at = 20, crack_histories = 24

   !> Constants of the plies of a zone that crack
   type, public :: crack_law_type
      !> Strengths across, along and through the thickness, (lanes, 3)
      real(wp) :: strength(lanes, 3) = 1.0_wp
      !> Traction per opening; thickness
      real(wp) :: stiffness(lanes) = 1.0_wp, thickness(lanes) = 1.0_wp
      !> Energy per area, coefficient of friction; largest opening that debris holds
      real(wp) :: toughness = 0.0_wp, friction = 0.0_wp, debris = 0.0_wp
   end type crack_law_type

contains

   !> Whether mean tractions start a crack. Pressure holds as much shear as its friction
   elemental logical function exceeds(law, lane, along_fibres, over, through)
      !> The law and one of its lanes
      type(crack_law_type), intent(in) :: law
      integer, intent(in) :: lane
      !> Tractions along the fibres, across the crack and along the thickness
      real(wp), intent(in) :: along_fibres, over, through

      real(wp) :: sheared

      associate (s => law%strength(lane, :))
         sheared = sqrt((along_fibres/s(2))**2 + (through/s(3))**2)
         if (over < 0.0_wp) sheared = max(sheared + law%friction*over/s(2), 0.0_wp)
         exceeds = (max(over, 0.0_wp)/s(1))**2 + sheared**2 >= 1.0_wp
      end associate
   end function exceeds

   !> Start a crack in one lane
   pure subroutine begin_crack(law, lane, time, traction, history)
      !> The law, and the lane that starts
      type(crack_law_type), intent(in) :: law
      integer, intent(in) :: lane
      !> Time, above 0; tractions in the axes of the crack, (axes, faces)
      real(wp), intent(in) :: time, traction(3, crack_faces)
      !> History of the lane
      real(wp), intent(out) :: history(crack_histories)

      real(wp) :: mean(3), size
      integer :: f

      mean(:) = sum(traction, 2)/real(crack_faces, wp)
      size = opened(traction)
      history(:) = 0.0_wp
      history(time_at) = time
      history(mode_at) = 1.0_wp - (max(mean(across), 0.0_wp)/opened(reshape(mean, [3, 1])))**2
      associate (stiffness => law%stiffness(lane))
         history(onset_at) = size/stiffness
         history(final_at) = history(onset_at) + 2.0_wp*law%toughness/size
         do f = 1, crack_faces
            history(start_at + 3*f - 2:start_at + 3*f) = traction(:, f)/stiffness
            history(slip_at + 2*f - 1:slip_at + 2*f) = traction([along, upward], f)/stiffness
         end do
      end associate
   end subroutine begin_crack

   !> Tractions of open cracks, and their history with them
   pure subroutine update_crack(law, is_open, opening, history, traction)
      type(crack_law_type), intent(in) :: law
      !> Lanes with an open crack
      logical, intent(in) :: is_open(lanes)
      !> Openings in the axes of the crack, (lanes, axes, faces)
      real(wp), intent(in) :: opening(lanes, 3, crack_faces)
      !> History, old in and new out
      real(wp), intent(inout) :: history(lanes, crack_histories)
      !> Tractions, 0 in other lanes
      real(wp), intent(out) :: traction(lanes, 3, crack_faces)

      integer :: l

      traction(:, :, :) = 0.0_wp
      do l = 1, lanes
         if (is_open(l)) call update_lane(law, l, opening(l, :, :), history(l, :), &
            & traction(l, :, :))
      end do
   end subroutine update_crack

   !> The same of one lane
   pure subroutine update_lane(law, lane, opening, history, traction)
      type(crack_law_type), intent(in) :: law
      integer, intent(in) :: lane
      real(wp), intent(in) :: opening(3, crack_faces)
      real(wp), intent(inout) :: history(crack_histories)
      real(wp), intent(out) :: traction(3, crack_faces)

      real(wp) :: before, closed(crack_faces), facing, fall, moved(3, crack_faces)
      integer :: f

      moved(:, :) = opening + reshape(history(start_at + 1:slip_at), [3, crack_faces])
      ! debris fills what has opened; it holds no face that touches it already
      associate (held => history(held_at + 1:held_at + crack_faces))
         held(:) = max(held, min(moved(across, :), law%debris))
      end associate
      closed(:) = overlap(moved, history)
      associate (stiffness => law%stiffness(lane), damage => history(damage_at))
         before = damage
         call grow(opened(moved), history)
         call find_facing(sum(moved(upward, :))/real(crack_faces, wp), law%thickness(lane), &
            & history, facing, fall)
         if (damage > before) call spend(law%stiffness(lane), before, moved, facing, history)
         do f = 1, crack_faces
            traction(:, f) = (1.0_wp - damage)*stiffness*moved(:, f)
            if (closed(f) < 0.0_wp) traction(across, f) = traction(across, f) &
               & + damage*facing*stiffness*closed(f)
            ! the mean slip of both faces changes the stiffness of each
            traction(upward, f) = traction(upward, f) + damage*fall*stiffness &
               & *sum(closed**2)/real(2*crack_faces, wp)
            if (damage > 0.0_wp) call add_friction(law%friction, stiffness, f, moved(:, f), &
               & before, damage, history, traction(:, f))
         end do
      end associate
   end subroutine update_lane

   !> How far faces would be inside of each other, or of what lies between them: 0 or below
   pure function overlap(moved, history)
      real(wp), intent(in) :: moved(3, crack_faces), history(crack_histories)
      real(wp) :: overlap(crack_faces)

      overlap(:) = min(moved(across, :) - history(held_at + 1:held_at + crack_faces), 0.0_wp)
   end function overlap

   !> Size of the opening of some faces: what is closed does not count
   pure real(wp) function opened(opening)
      !> (axes, faces)
      real(wp), intent(in) :: opening(:, :)

      opened = sqrt((sum(opening([along, upward], :)**2) &
         & + sum(max(opening(across, :), 0.0_wp)**2))/real(size(opening, 2), wp))
   end function opened

   !> Energy per area and stiffness that softening to a damage takes, with that of the start
   pure real(wp) function spent(history, damage)
      real(wp), intent(in) :: history(crack_histories), damage

      associate (onset => history(onset_at), final => history(final_at))
         spent = 0.5_wp*onset**2*final*damage/(final - damage*(final - onset))
      end associate
   end function spent

   !> Damage on a line from the opening at the start to that at the end
   pure subroutine grow(size, history)
      real(wp), intent(in) :: size
      real(wp), intent(inout) :: history(crack_histories)

      associate (onset => history(onset_at), final => history(final_at))
         if (size <= onset) return
         history(damage_at) = max(history(damage_at), min(1.0_wp, final*(size - onset) &
            & /(size*(final - onset))))
      end associate
   end subroutine grow

   !> Share of the stiffness with which closed faces meet, and its slope over the slip along the
   !> thickness
   pure subroutine find_facing(slip, thickness, history, facing, fall)
      real(wp), intent(in) :: slip, thickness
      real(wp), intent(inout) :: history(crack_histories)
      real(wp), intent(out) :: facing, fall

      facing = 1.0_wp - 2.0_wp*abs(slip)/thickness
      fall = -sign(2.0_wp/thickness, slip)
      if (facing <= 0.0_wp) history(apart_at) = 1.0_wp
      if (history(apart_at) <= 0.0_wp) return
      facing = 0.0_wp
      fall = 0.0_wp
   end subroutine find_facing

   !> Count the energy that growing damage takes
   pure subroutine spend(stiffness, before, moved, facing, history)
      real(wp), intent(in) :: stiffness
      !> Damage before; openings of the faces; share of the stiffness with which they meet
      real(wp), intent(in) :: before, moved(3, crack_faces), facing
      real(wp), intent(inout) :: history(crack_histories)

      real(wp) :: closed, start(3, crack_faces)
      integer :: f, k

      ! no work has been done on the openings of the start
      start(:, :) = reshape(history(start_at + 1:slip_at), [3, crack_faces])

      ! closed faces lose what their contact bears less
      closed = (sum(min(moved(across, :), 0.0_wp)**2) - facing*sum(overlap(moved, history)**2)) &
         & /real(crack_faces, wp)
      associate (damage => history(damage_at), slip => history(slip_at + 1:))
         ! what breaks now has not slid yet
         do f = 1, crack_faces
            do k = 1, 2
               associate (own => slip(k + 2*(f - 1)), &
                  & here => moved(merge(along, upward, k == 1), f))
                  own = here - before/damage*(here - own)
               end associate
            end do
         end do
         history(fracture_at) = history(fracture_at) + stiffness*(spent(history, damage) &
            & - spent(history, before) + 0.5_wp*(damage - before)*(closed - opened(start)**2))
      end associate
   end subroutine spend

   !> Friction of the damaged share of closed faces: the work of its mean over the step, less what
   !> faces that stick store by their stretch
   pure subroutine add_friction(friction, stiffness, face, moved, before, damage, history, traction)
      real(wp), intent(in) :: friction, stiffness
      integer, intent(in) :: face
      !> Opening of the face; damage before, and now
      real(wp), intent(in) :: moved(3), before, damage
      real(wp), intent(inout) :: history(crack_histories), traction(3)

      real(wp) :: held(2), share, stretch(2), trial, whole(2)

      associate (slip => history(slip_at + 2*face - 1:slip_at + 2*face), &
         & last => history(traction_at + 2*face - 1:traction_at + 2*face))
         stretch(:) = moved([along, upward]) - slip
         trial = stiffness*norm2(stretch)
         share = 1.0_wp
         if (trial > 0.0_wp) share = min(friction*max(-traction(across), 0.0_wp)/trial, 1.0_wp)
         held(:) = damage*share*stiffness*stretch
         if (before > 0.0_wp) then
            ! one slip for all that has failed: what breaks takes some of the stretch
            whole(:) = damage/before*stretch
            history(friction_at) = history(friction_at) + 0.5_wp*(dot_product(last, whole) &
               & + dot_product(held, whole - share*stretch - last/(before*stiffness))) &
               & /real(crack_faces, wp)
         end if
         slip = moved([along, upward]) - share*stretch
         last = held
         traction([along, upward]) = traction([along, upward]) + held
      end associate
   end subroutine add_friction

   !> Energy per area that an open crack gives back, 0 at its start
   pure real(wp) function crack_energy(law, lane, opening, history) result(energy)
      type(crack_law_type), intent(in) :: law
      integer, intent(in) :: lane
      !> Openings in the axes of the crack, (axes, faces); history of the lane
      real(wp), intent(in) :: opening(3, crack_faces), history(crack_histories)

      real(wp) :: facing, fall, moved(3, crack_faces), start(3, crack_faces)
      real(wp) :: unused(crack_histories)
      integer :: f

      start(:, :) = reshape(history(start_at + 1:slip_at), [3, crack_faces])
      moved(:, :) = opening + start
      unused(:) = history
      call find_facing(sum(moved(upward, :))/real(crack_faces, wp), law%thickness(lane), unused, &
         & facing, fall)
      associate (stiffness => law%stiffness(lane), damage => history(damage_at))
         energy = (1.0_wp - damage)*(sum(moved**2) - sum(start**2)) + damage*(facing &
            & *sum(overlap(moved, history)**2) - sum(min(start(across, :), 0.0_wp)**2))
         do f = 1, crack_faces
            energy = energy + damage*sum((moved([along, upward], f) &
               & - history(slip_at + 2*f - 1:slip_at + 2*f))**2)
         end do
         energy = 0.5_wp*stiffness*energy/real(crack_faces, wp)
      end associate
   end function crack_energy

end module plydyn_law_matrix_crack
