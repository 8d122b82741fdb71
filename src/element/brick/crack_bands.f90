!> Widths of the crack bands of bricks, and the histories of their points at time zero.
module plydyn_element_brick_crack_bands
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_crack_bands, only : add_band_points, crack_band_type
   use plydyn_element_brick_bricks, only : brick_shape_type, bricks_type, parent_slope
   use plydyn_law_ply_crack_band, only : brick_band_length
   use plydyn_law_law, only : law_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_brick_bands, start_brick_history

   !> Normal of the plies
   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

contains

   !> Let the law of the bricks of a part start their histories
   pure subroutine start_brick_history(bricks, history)
      !> The bricks
      type(bricks_type), intent(in) :: bricks
      !> History of the part, zero in
      real(wp), intent(inout) :: history(lanes, bricks%histories, bricks%points, *)

      real(wp) :: length(lanes, 2, bricks%points), widest(lanes)
      integer :: b, m

      if (size(bricks%laws) == 0) return
      associate (law => bricks%laws(1)%law)
         do b = 1, size(bricks%shape)
            do m = 1, bricks%points
               length(:, :, m) = brick_band_lengths(bricks, bricks%shapes(bricks%shape(b)), law, m)
            end do
            widest(:) = maxval(maxval(length, 3), 2)
            do m = 1, bricks%points
               call law%start_history(length(:, :, m), widest, history(:, :, m, b))
            end do
         end do
      end associate
   end subroutine start_brick_history

   !> Add the bands of the bricks of a part
   subroutine add_brick_bands(model, bricks, group, bands)
      !> The model
      type(model_type), intent(in) :: model
      !> The bricks
      type(bricks_type), intent(in) :: bricks
      !> Index of the element group
      integer, intent(in) :: group
      !> Bands of each material
      type(crack_band_type), intent(inout) :: bands(:)

      real(wp) :: length(lanes, 2)
      integer :: e, i, l, m

      if (size(bricks%laws) == 0) return
      associate (law => bricks%laws(1)%law, material => model%parts(bricks%part)%plies(1)%material)
         if (all(law%band_rule == 0)) return
         do i = 1, size(bricks%shape)
            do m = 1, bricks%points
               length(:, :) = brick_band_lengths(bricks, bricks%shapes(bricks%shape(i)), law, m)
               do l = 1, min(lanes, size(bricks%brick) - lanes*(i - 1))
                  e = bricks%brick(lanes*(i - 1) + l)
                  call add_band_points(model%materials(material), [e, 0, group], length(l, :), &
                     & 1, bands(material))
               end do
            end do
         end do
      end associate
   end subroutine add_brick_bands

   !> Widths of the crack band at a point of the bricks of a batch, for fibres and for matrix,
   !> (lanes, 2); 0 in lanes that do not soften, 1 in lanes without a brick
   pure function brick_band_lengths(bricks, shape, law, point) result(length)
      !> The bricks of a part
      type(bricks_type), intent(in) :: bricks
      !> Geometry of the batch
      type(brick_shape_type), intent(in) :: shape
      !> The law of the lanes
      class(law_type), intent(in) :: law
      !> The point
      integer, intent(in) :: point
      real(wp) :: length(lanes, 2)

      !> Side of the cube of a point of one, and of one of eight
      real(wp), parameter :: whole = 2.0_wp, eighth = 1.0_wp
      real(wp) :: axis(3, 2), side, slope(3, 3), volume(2)
      integer :: k, l

      side = merge(whole, eighth, bricks%points == 1)
      axis(:, 1) = [bricks%rotation(1, 1, 1), bricks%rotation(1, 2, 1), 0.0_wp]
      axis(:, 2) = [-bricks%rotation(1, 2, 1), bricks%rotation(1, 1, 1), 0.0_wp]
      length(:, :) = 0.0_wp
      do l = 1, lanes
         if (law%band_rule(l) == 0) cycle
         length(l, :) = 1.0_wp
         if (shape%volume(l, point) <= 0.0_wp) cycle
         slope(:, :) = parent_slope(shape, l, point)
         volume(:) = [shape%volume(l, point), sum(shape%volume(l, :))]
         do k = 1, 2
            length(l, k) = brick_band_length(law%band_rule(l), slope, axis(:, k), up, side, volume)
         end do
         if (law%band_width(l) > 0.0_wp) length(l, :) = law%band_width(l)
      end do
   end function brick_band_lengths

end module plydyn_element_brick_crack_bands
