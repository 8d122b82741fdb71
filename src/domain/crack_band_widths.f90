!> Widths of the crack bands that a mesh gives to the plies that are damaged, and what they do.
module plydyn_domain_crack_band_widths
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : lanes, wp
   use plydyn_base_text, only : text
   use plydyn_domain_brick_crack_bands, only : brick_band_lengths
   use plydyn_domain_domain, only : crack_band_type, domain_type
   use plydyn_domain_initial_history, only : band_lengths
   use plydyn_element_brick, only : bricks_type
   use plydyn_element_plate_layers, only : layer_batch_type
   use plydyn_law_ply_crack_band, only : modes
   use plydyn_model_model, only : model_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: check_bands, find_bands

   !> Numbers that tell where the widest band of a direction is: width, quad and ply
   integer, parameter :: numbers = 3

contains

   !> Refuse bands that snap back, where a material asks for that
   subroutine check_bands(model, domain, error)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain with its crack bands
      type(domain_type), intent(in) :: domain
      !> Names the quad or brick, the mode and the width that would be right
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: cause
      real(wp) :: length(2)
      integer :: i, k

      do i = 1, size(domain%crack_bands)
         associate (material => model%materials(i), band => domain%crack_bands(i))
            if (band%points == 0) cycle
            do k = 1, 2
               length(:) = 0.0_wp
               length(k) = band%widest(k)
               call material%law%refuse_snap_back(length, cause)
               if (.not. allocated(cause)) cycle
               call fail(error, exit_input, "error: "//material%place//": *"//material%keyword &
                  & //" SNAP: in "//place_of(model, band, k)//", "//cause%message)
               return
            end do
         end associate
      end do
   end subroutine check_bands

   !> Where the widest band is, in the user's numbers
   pure function place_of(model, band, k) result(words)
      type(model_type), intent(in) :: model
      type(crack_band_type), intent(in) :: band
      !> Fibres or matrix
      integer, intent(in) :: k
      character(:), allocatable :: words

      if (size(model%mesh%brick_id) > 0) then
         words = "brick "//text(model%mesh%brick_id(band%quad(k)))
      else
         words = "quad "//text(model%mesh%quad_id(band%quad(k)))//", ply "//text(band%ply(k)) &
            & //" from the bottom"
      end if
   end function place_of

   !> Crack bands of each material of the model. All ranks must come here, and get the same
   function find_bands(model, domain) result(bands)
      !> The model
      type(model_type), intent(in) :: model
      !> The domain with the plates or bricks of this rank
      type(domain_type), intent(in) :: domain
      type(crack_band_type) :: bands(size(model%materials))

      integer :: b, p

      do p = 1, size(domain%bricks)
         call add_bricks(model, domain%bricks(p), bands)
      end do
      do p = 1, size(domain%plates)
         do b = 1, size(domain%plates(p)%batches)
            call add_batch(model, domain, p, domain%plates(p)%batches(b), bands)
         end do
      end do
      if (domain%comm%ranks > 1) call bring_together(domain%comm, bands)
   end function find_bands

   !> Let all ranks have the bands of all
   subroutine bring_together(comm, bands)
      type(comm_type), intent(in) :: comm
      !> Those of this rank in, those of all out
      type(crack_band_type), intent(inout) :: bands(:)

      integer(int64) :: counts(1 + modes, size(bands))
      real(wp) :: each(2*numbers*size(bands)*comm%ranks), less(2*size(bands)), &
         & own(2*numbers*size(bands))
      integer :: i, k, place, r

      do i = 1, size(bands)
         less(2*i - 1:2*i) = -bands(i)%narrowest
         counts(:, i) = [bands(i)%points, bands(i)%too_wide]
         do k = 1, 2
            place = numbers*(k - 1 + 2*(i - 1))
            own(place + 1:place + numbers) = [bands(i)%widest(k), real(bands(i)%quad(k), wp), &
               & real(bands(i)%ply(k), wp)]
         end do
      end do
      call comm%max(less)
      call comm%sum(counts)
      call comm%allgather(own, [(size(own), r=1, comm%ranks)], each)
      do i = 1, size(bands)
         bands(i)%narrowest(:) = -less(2*i - 1:2*i)
         bands(i)%points = int(counts(1, i))
         bands(i)%too_wide(:) = int(counts(2:, i))
         do r = 0, comm%ranks - 1
            do k = 1, 2
               place = size(own)*r + numbers*(k - 1 + 2*(i - 1))
               call widen(each(place + 1), nint(each(place + 2:place + 3)), k, bands(i))
            end do
         end do
      end do
   end subroutine bring_together

   !> Note a band if it is the widest, or the first of the widest
   pure subroutine widen(width, place, k, band)
      real(wp), intent(in) :: width
      !> Quad or brick, and ply
      integer, intent(in) :: place(2)
      !> Fibres or matrix
      integer, intent(in) :: k
      type(crack_band_type), intent(inout) :: band

      if (width <= 0.0_wp .or. width < band%widest(k)) return
      if (width <= band%widest(k)) then
         if (place(1) > band%quad(k)) return
         if (place(1) == band%quad(k) .and. place(2) >= band%ply(k)) return
      end if
      band%widest(k) = width
      band%quad(k) = place(1)
      band%ply(k) = place(2)
   end subroutine widen

   !> Add the bands of a batch of layers of a part
   subroutine add_batch(model, domain, p, batch, bands)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: p
      type(layer_batch_type), intent(in) :: batch
      type(crack_band_type), intent(inout) :: bands(:)

      real(wp) :: length(lanes, 2)
      integer :: e, k, l, ply, q

      associate (plate => domain%plates(p))
         do k = 1, size(batch%laws)
            associate (law => batch%laws(k)%law, block => batch%laws(k)%block)
               if (all(law%band_rule == 0)) cycle
               do e = 1, size(plate%quad)
                  do q = 1, size(plate%node, 1)
                     length(:, :) = band_lengths(plate, batch%rotation(:, :, block), law, q, e)
                     do l = 1, lanes
                        if (law%band_rule(l) == 0 .or. batch%layer(l, block) == 0) cycle
                        ply = domain%layers%ply(batch%layer(l, block))
                        call add_points(model, model%parts(p)%plies(ply)%material, &
                           & [plate%quad(e), ply], length(l, :), batch%expansion%order + 1, bands)
                     end do
                  end do
               end do
            end associate
         end do
      end associate
   end subroutine add_batch

   !> Add the bands of bricks of a part
   subroutine add_bricks(model, bricks, bands)
      type(model_type), intent(in) :: model
      type(bricks_type), intent(in) :: bricks
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
                  call add_points(model, material, [e, 1], length(l, :), 1, bands)
               end do
            end do
         end do
      end associate
   end subroutine add_bricks

   !> Add the bands of points with one width, such as those above each other in a layer
   pure subroutine add_points(model, material, place, length, points, bands)
      type(model_type), intent(in) :: model
      integer, intent(in) :: material
      !> Quad or brick, and ply
      integer, intent(in) :: place(2)
      !> Widths for fibres and for matrix
      real(wp), intent(in) :: length(2)
      integer, intent(in) :: points
      type(crack_band_type), intent(inout) :: bands(:)

      integer :: k

      associate (band => bands(material))
         do k = 1, 2
            band%narrowest(k) = min(band%narrowest(k), length(k))
            call widen(length(k), place, k, band)
         end do
         band%points = band%points + points
         where (model%materials(material)%law%snaps_back(length))
            band%too_wide(:) = band%too_wide + points
         end where
      end associate
   end subroutine add_points

end module plydyn_domain_crack_band_widths
