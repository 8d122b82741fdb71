!> Broadcast of the decks, word for word: the root alone reads the files.
module plydyn_parallel_broadcast_archive
   use plydyn_base_archive, only : archive_type, bundle_type
   use plydyn_base_precision, only : wp
   use plydyn_parallel_comm, only : comm_type
   implicit none
   private

   public :: broadcast_archive

contains

   !> Let all ranks have the decks and the parameters of the root
   subroutine broadcast_archive(comm, archive)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> The root's in, the same on all ranks out
      type(archive_type), intent(inout) :: archive

      type(bundle_type) :: bundle
      integer :: b, count(1)

      call comm%broadcast(archive%parameters)
      if (comm%is_root()) count(1) = size(archive%bundles)
      call comm%broadcast(count)
      if (.not. comm%is_root()) then
         if (allocated(archive%bundles)) deallocate (archive%bundles)
         allocate (archive%bundles(0))
      end if
      do b = 1, count(1)
         if (comm%is_root()) then
            call broadcast_bundle(comm, archive%bundles(b))
         else
            call broadcast_bundle(comm, bundle)
            call archive%add_bundle(bundle)
         end if
      end do
   end subroutine broadcast_archive

   !> A deck and the files that it includes
   subroutine broadcast_bundle(comm, bundle)
      type(comm_type), intent(in) :: comm
      type(bundle_type), intent(inout) :: bundle

      character(:), allocatable :: content, path
      integer :: count(1), d
      real(wp) :: start(1)

      start(1) = bundle%start
      call comm%broadcast(start)
      bundle%start = start(1)
      if (comm%is_root()) count(1) = size(bundle%documents)
      call comm%broadcast(count)
      if (.not. comm%is_root()) then
         if (allocated(bundle%documents)) deallocate (bundle%documents)
         allocate (bundle%documents(0))
      end if
      do d = 1, count(1)
         if (comm%is_root()) then
            path = bundle%documents(d)%path
            content = bundle%documents(d)%content
         end if
         call comm%broadcast(path)
         call comm%broadcast(content)
         if (.not. comm%is_root()) call bundle%add_document(path, content)
      end do
   end subroutine broadcast_bundle

end module plydyn_parallel_broadcast_archive
