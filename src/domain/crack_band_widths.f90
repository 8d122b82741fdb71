!> Widths of the crack bands that a mesh gives to the plies that are damaged, and what they do.
module plydyn_domain_crack_band_widths
   use, intrinsic :: iso_fortran_env, only : int64
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_crack_bands, only : crack_band_type, widen
   use plydyn_law_ply_crack_band, only : modes
   use plydyn_model_model, only : model_type
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: check_bands, find_bands

   !> Place of the widest band of a direction: width, element, ply and group
   integer, parameter :: numbers = 4

contains

   !> Refuse bands that snap back, where a material asks for that
   subroutine check_bands(model, domain, error)
      type(model_type), intent(in) :: model
      !> The domain with its crack bands
      type(domain_type), intent(in) :: domain
      !> Names the element, the mode and the width that would be right
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
                  & //" SNAP: in "//place_of(model, domain, band, k)//", "//cause%message)
               return
            end do
         end associate
      end do
   end subroutine check_bands

   !> Where the widest band is, in the user's numbers
   pure function place_of(model, domain, band, k) result(words)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(crack_band_type), intent(in) :: band
      !> Fibres or matrix
      integer, intent(in) :: k
      character(:), allocatable :: words

      associate (group => domain%groups(band%group(k))%item)
         words = group%element_kind//" "//text(model%mesh%element_id( &
            & group%element_kind, band%element(k)))
         if (band%ply(k) > 0) words = words//", ply "//text(band%ply(k))//" from the bottom"
      end associate
   end function place_of

   !> Crack bands of each material of the model. All ranks must come here, and get the same
   function find_bands(model, domain) result(bands)
      type(model_type), intent(in) :: model
      !> The domain with the elements of this rank
      type(domain_type), intent(in) :: domain
      type(crack_band_type) :: bands(size(model%materials))

      integer :: g

      do g = 1, size(domain%groups)
         call domain%groups(g)%item%add_crack_bands(model, bands)
      end do
      call bring_together(domain%comm, bands)
   end function find_bands

   !> Let all ranks have the bands of all
   subroutine bring_together(comm, bands)
      type(comm_type), intent(in) :: comm
      !> Those of this rank in, those of all out
      type(crack_band_type), intent(inout) :: bands(:)

      integer(int64) :: counts(1 + modes, size(bands))
      real(wp) :: each(2*numbers*size(bands)*comm%ranks), least(2*size(bands)), &
         & own(2*numbers*size(bands))
      integer :: i, k, place, r

      do i = 1, size(bands)
         least(2*i - 1:2*i) = -bands(i)%narrowest
         counts(:, i) = [bands(i)%points, bands(i)%too_wide]
         do k = 1, 2
            place = numbers*(k - 1 + 2*(i - 1))
            own(place + 1:place + numbers) = [bands(i)%widest(k), real([bands(i)%element(k), &
               & bands(i)%ply(k), bands(i)%group(k)], wp)]
         end do
      end do
      call comm%max(least)
      call comm%sum(counts)
      call comm%allgather(own, [(size(own), r=1, comm%ranks)], each)
      do i = 1, size(bands)
         bands(i)%narrowest(:) = -least(2*i - 1:2*i)
         bands(i)%points = int(counts(1, i))
         bands(i)%too_wide(:) = int(counts(2:, i))
         do r = 0, comm%ranks - 1
            do k = 1, 2
               place = size(own)*r + numbers*(k - 1 + 2*(i - 1))
               call widen(each(place + 1), nint(each(place + 2:place + numbers)), k, bands(i))
            end do
         end do
      end do
   end subroutine bring_together

end module plydyn_domain_crack_band_widths
