!> Onset of damage of fibres and of matrix: when, and the strains between which it grows.
!>
!> Stresses are trial stresses along and across the fibres, of a ply that is intact there, with the
!> shear on its curve. Where the crack band is too wide for the toughness, damage starts as soon as
!> the work of the mode leaves no less than the asked ratio of the two strains: in uniaxial stress
!> this is the strength sqrt(2 E G/(length*ratio)), and it holds on any other path.
module plydyn_law_ply_damage_onset
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_constants, only : in_compression, in_tension, onset_hashin, &
      & ply_constants_type, snap_drop
   use plydyn_law_ply_fibre_lines, only : at_once, first_reach, last_reach
   implicit none
   private

   !> Constants of the lanes
   type, public :: onset_type
      private
      !> Least strain of a mode at onset over its stress, along and across the fibres
      real(wp) :: least(lanes, 2) = 0.0_wp
      !> Inverse squares of XT, XC and S12
      real(wp) :: fibre(lanes, 2) = 0.0_wp, shear(lanes) = 0.0_wp
      !> Factors of the square of the stress across, in tension and in compression, and of the
      !> stress itself in compression
      real(wp) :: matrix(lanes, 2) = 0.0_wp, linear(lanes) = 0.0_wp
      !> Twice the energies per area of crack: fibres, of one line with the end of the law that ends
      !> first; matrix; matrix by shear; each in tension and in compression
      real(wp) :: fibre_toughness(lanes, 2) = 1.0_wp, matrix_toughness(lanes, 2) = 1.0_wp
      real(wp) :: shear_toughness(lanes, 2) = 1.0_wp
      !> End of the law of fibres that ends last over that of the other
      real(wp) :: fibre_reach(lanes, 2) = 1.0_wp
      !> Least ratio of the strains at the end and at onset; 0: any
      real(wp) :: ratio(lanes) = 0.0_wp
      !> Factors of two sums that are below 1 far from onset, one for each mode. Fibres: of the
      !> square of stress 11; and, times the width of the band, of that and of stress times strain
      !> 11. Matrix: of the squares of stress 22 and shear 12; and, times the width, of that of
      !> stress 22 and of the work of both
      real(wp), public :: far_fibre(lanes, 3) = 0.0_wp, far_matrix(lanes, 4) = 0.0_wp
   contains
      procedure :: set_lane
      procedure :: find_onset
      procedure :: begin_fibre
      procedure :: begin_matrix
   end type onset_type

   !> Least strain of a mode at onset, as a share of that in uniaxial stress. Poisson's effect can
   !> bring the stress of a mode to its strength with little strain of it, or none
   real(wp), parameter :: least_share = 0.1_wp
   !> Compression across the fibres up to this share of the shear stress counts as tension: in pure
   !> shear round-off must not choose between two toughnesses
   real(wp), parameter, public :: compression_tolerance = 1.0e-3_wp

contains

   !> Give a lane its constants
   pure subroutine set_lane(self, lane, constants)
      class(onset_type), intent(inout) :: self
      integer, intent(in) :: lane
      !> Its ply
      class(ply_constants_type), intent(in) :: constants

      real(wp) :: cross

      self%least(lane, :) = least_share/constants%young(1:2)
      self%fibre(lane, :) = 1.0_wp/constants%fibre_strength**2
      self%matrix(lane, :) = 1.0_wp/constants%matrix_strength**2
      self%shear(lane) = 1.0_wp/constants%shear_strength**2
      self%linear(lane) = 0.0_wp
      if (constants%onset == onset_hashin) then
         cross = 1.0_wp/(2.0_wp*constants%cross_strength)
         associate (strength => constants%matrix_strength(in_compression))
            self%matrix(lane, in_compression) = cross**2
            self%linear(lane) = ((strength*cross)**2 - 1.0_wp)/strength
         end associate
      end if

      ! a plateau leaves less stress to soften: the line ends at a larger strain
      associate (first => first_reach(constants%line_strength, constants%line_toughness))
         self%fibre_toughness(lane, :) = 2.0_wp*constants%fibre_toughness*first
         self%fibre_reach(lane, :) = last_reach(constants%line_strength, &
            & constants%line_toughness)/first
      end associate
      self%fibre_toughness(lane, in_compression) = &
         & self%fibre_toughness(lane, in_compression)/(1.0_wp - constants%plateau)**2
      self%matrix_toughness(lane, :) = 2.0_wp*constants%matrix_toughness
      self%shear_toughness(lane, :) = self%matrix_toughness(lane, :)
      if (constants%shear_toughness > 0.0_wp) then
         self%shear_toughness(lane, :) = 2.0_wp*constants%shear_toughness
      end if
      self%ratio(lane) = merge(0.0_wp, constants%snap_ratio, constants%snap_back == snap_drop)
      call set_far(self, lane, constants)
   end subroutine set_lane

   !> Factors of the sums that are below 1 far from onset: never less than what `find_onset` takes
   pure subroutine set_far(self, lane, constants)
      class(onset_type), intent(inout) :: self
      integer, intent(in) :: lane
      class(ply_constants_type), intent(in) :: constants

      real(wp) :: toughness, weight

      toughness = minval(self%fibre_toughness(lane, :))
      self%far_fibre(lane, 1) = maxval(self%fibre(lane, :))
      self%far_fibre(lane, 2) = self%ratio(lane)*self%least(lane, 1)/toughness
      self%far_fibre(lane, 3) = self%ratio(lane)/toughness

      ! a criterion with a linear term lies below the line to its strength: up to half of that the
      ! line takes no more than a half, and shear the other half
      weight = merge(2.0_wp, 1.0_wp, constants%onset == onset_hashin)
      toughness = min(minval(self%matrix_toughness(lane, :)), minval(self%shear_toughness(lane, :)))
      self%far_matrix(lane, 1) = weight**2*maxval(1.0_wp/constants%matrix_strength**2)
      self%far_matrix(lane, 2) = weight*self%shear(lane)
      self%far_matrix(lane, 3) = self%ratio(lane)*self%least(lane, 2)/toughness
      self%far_matrix(lane, 4) = self%ratio(lane)/toughness
   end subroutine set_far

   !> How far beyond onset the modes of a point are: 0 or more where damage starts
   pure subroutine find_onset(self, stress, strain, shear, fibre_width, matrix_width, excess)
      class(onset_type), intent(in) :: self
      !> Trial stresses and strains 11 and 22
      real(wp), intent(in) :: stress(lanes, 2), strain(lanes, 2)
      !> Sizes of the shear stress on its curve and of the elastic shear strain
      real(wp), intent(in) :: shear(lanes, 2)
      !> Widths of the crack band for fibres and for matrix, where none has begun
      real(wp), intent(in) :: fibre_width(lanes), matrix_width(lanes)
      !> Of fibres and of matrix; only the sign has a meaning, and none where damage has begun
      real(wp), intent(out) :: excess(lanes, 2)

      call find_fibre_onset(self, stress(:, 1), strain(:, 1), fibre_width, excess(:, 1))
      call find_matrix_onset(self, stress(:, 2), strain(:, 2), shear, matrix_width, &
         & excess(:, 2))
   end subroutine find_onset

   !> How far beyond onset the fibres of a point are
   pure subroutine find_fibre_onset(self, stress, strain, length, excess)
      type(onset_type), intent(in) :: self
      real(wp), intent(in) :: stress(lanes), strain(lanes), length(lanes)
      real(wp), intent(out) :: excess(lanes)

      real(wp) :: criterion, in_c, in_t, s, toughness, work
      integer :: l

      associate (least => self%least, t => in_tension, c => in_compression)
         !$omp simd private(s, in_t, in_c, criterion, toughness, work)
         do l = 1, lanes
            s = stress(l)
            in_t = self%fibre(l, t)
            in_c = self%fibre(l, c)
            criterion = merge(in_t, in_c, s >= 0.0_wp)*s**2
            in_t = self%fibre_toughness(l, t)
            in_c = self%fibre_toughness(l, c)
            toughness = merge(in_t, in_c, s >= 0.0_wp)
            work = max(abs(s*strain(l)), least(l, 1)*s**2)
            excess(l) = max(criterion - 1.0_wp, self%ratio(l)*length(l)*work - toughness)
         end do
      end associate
   end subroutine find_fibre_onset

   !> How far beyond onset the matrix of a point is
   pure subroutine find_matrix_onset(self, stress, strain, shear, length, excess)
      type(onset_type), intent(in) :: self
      real(wp), intent(in) :: stress(lanes), strain(lanes), shear(lanes, 2), length(lanes)
      real(wp), intent(out) :: excess(lanes)

      real(wp) :: by_shear, criterion, in_c, in_t, linear, s, tolerance, toughness, work
      integer :: l

      associate (least => self%least, t => in_tension, c => in_compression)
         !$omp simd private(s, by_shear, in_t, in_c, linear, criterion, tolerance, toughness, work)
         do l = 1, lanes
            s = stress(l)
            in_t = self%matrix(l, t)
            in_c = self%matrix(l, c)
            linear = self%linear(l)*min(s, 0.0_wp)
            criterion = self%shear(l)*shear(l, 1)**2 + merge(in_t, in_c, s >= 0.0_wp)*s**2 &
               & + linear
            work = max(s*strain(l), least(l, 2)*s**2)
            by_shear = shear(l, 1)*shear(l, 2)
            in_t = self%matrix_toughness(l, t)
            in_c = self%matrix_toughness(l, c)
            tolerance = compression_tolerance*shear(l, 1)
            toughness = work*merge(in_t, in_c, s >= -tolerance) + tiny(toughness)
            in_t = self%shear_toughness(l, t)
            in_c = self%shear_toughness(l, c)
            toughness = toughness + by_shear*merge(in_t, in_c, s >= -tolerance)
            work = work + by_shear
            excess(l) = max(criterion - 1.0_wp, self%ratio(l)*length(l)*work**2 - toughness)
         end do
      end associate
   end subroutine find_matrix_onset

   !> Strains between which the damage of fibres grows, from a state at onset or beyond
   pure subroutine begin_fibre(self, lane, stress, strain, length, onset, finish)
      class(onset_type), intent(in) :: self
      integer, intent(in) :: lane
      !> Trial stress and strain 11; width of the crack band
      real(wp), intent(in) :: stress, strain, length
      !> Strain at onset, negative in compression, and strain at the end, positive
      real(wp), intent(out) :: onset, finish

      real(wp) :: criterion, scale, size, toughness
      integer :: sense

      sense = merge(in_tension, in_compression, stress >= 0.0_wp)
      toughness = self%fibre_toughness(lane, sense)/length
      size = max(abs(strain), self%least(lane, 1)*abs(stress))
      ! the state on the surface of onset, behind which the step may have led
      criterion = max(self%fibre(lane, sense)*stress**2, &
         & self%ratio(lane)*abs(stress)*size/toughness)
      scale = 1.0_wp/sqrt(criterion)
      finish = max(self%fibre_reach(lane, sense)*toughness/(scale*abs(stress)), &
         & scale*size*at_once)
      onset = sign(scale*size, stress)
   end subroutine begin_fibre

   !> Strains between which the damage of matrix grows, from a state at onset or beyond
   pure subroutine begin_matrix(self, lane, stress, strain, shear, length, onset, finish)
      class(onset_type), intent(in) :: self
      integer, intent(in) :: lane
      !> Trial stress and strain 22
      real(wp), intent(in) :: stress, strain
      !> Sizes of the shear stress on its curve and of the elastic shear strain
      real(wp), intent(in) :: shear(2)
      !> Width of the crack band
      real(wp), intent(in) :: length
      !> Equivalent strain at onset, negative in compression, and at the end, positive
      real(wp), intent(out) :: onset, finish

      real(wp) :: by_shear, least, linear, scale, size, square, toughness, work
      integer :: sense, side

      sense = merge(in_tension, in_compression, stress >= -compression_tolerance*shear(1))
      least = self%least(lane, 2)*abs(stress)
      work = max(stress*strain, least*abs(stress))
      by_shear = shear(1)*shear(2)
      ! the toughnesses count by the shares of work
      toughness = (work*self%matrix_toughness(lane, sense) &
         & + by_shear*self%shear_toughness(lane, sense))/((work + by_shear)*length)
      work = work + by_shear
      ! what brings stress across and shear onto the surface of onset
      side = merge(in_tension, in_compression, stress >= 0.0_wp)
      linear = merge(0.0_wp, self%linear(lane)*stress, side == in_tension)
      square = self%matrix(lane, side)*stress**2 + self%shear(lane)*shear(1)**2
      scale = 2.0_wp/(linear + sqrt(linear**2 + 4.0_wp*square))
      scale = min(scale, 1.0_wp/sqrt(max(self%ratio(lane)*work/toughness, tiny(work))))
      size = scale*sqrt(max(abs(strain), least)**2 + shear(2)**2)
      ! equivalent stress: work of the mode over its strain
      finish = max(toughness*size/(scale**2*work), size*at_once)
      onset = sign(size, stress)
   end subroutine begin_matrix

end module plydyn_law_ply_damage_onset
