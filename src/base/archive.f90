!> Verbatim copies of the decks of a run, for restarts without the original files.
module plydyn_base_archive
   use plydyn_base_precision, only : wp
   implicit none
   private

   !> A file
   type :: document_type
      !> Path, as the deck or the user wrote it
      character(:), allocatable :: path
      !> Its content
      character(:), allocatable :: content
   end type document_type

   !> A deck and all files that it includes, the deck first
   type, public :: bundle_type
      !> The files
      type(document_type), allocatable :: documents(:)
      !> Time from which the run follows the deck
      real(wp) :: start = 0.0_wp
   contains
      procedure :: find
      procedure :: add_document
   end type bundle_type

   !> The deck of a run and the decks of its restarts, in their order
   type, public :: archive_type
      !> The decks
      type(bundle_type), allocatable :: bundles(:)
      !> Parameters set on the command line, as in `velocity=3.0`
      character(:), allocatable :: parameters
   contains
      procedure :: add_bundle
   end type archive_type

contains

   !> Index of a file; 0 when there is none of that path
   pure integer function find(self, path) result(i)
      class(bundle_type), intent(in) :: self
      !> Path of the file
      character(*), intent(in) :: path

      do i = size(self%documents), 1, -1
         if (self%documents(i)%path == path) return
      end do
      i = 0
   end function find

   !> Append a file
   pure subroutine add_document(self, path, content)
      class(bundle_type), intent(inout) :: self
      !> Path of the file, and its content
      character(*), intent(in) :: path, content

      type(document_type), allocatable :: longer(:)
      integer :: i

      ! element by element: gfortran 12 frees texts copied by an array constructor twice
      allocate (longer(size(self%documents) + 1))
      do i = 1, size(self%documents)
         call move_alloc(self%documents(i)%path, longer(i)%path)
         call move_alloc(self%documents(i)%content, longer(i)%content)
      end do
      longer(size(longer))%path = path
      longer(size(longer))%content = content
      call move_alloc(longer, self%documents)
   end subroutine add_document

   !> Append a deck
   pure subroutine add_bundle(self, bundle)
      class(archive_type), intent(inout) :: self
      !> The deck with its files
      type(bundle_type), intent(in) :: bundle

      type(bundle_type), allocatable :: longer(:)
      integer :: i

      allocate (longer(size(self%bundles) + 1))
      do i = 1, size(self%bundles)
         call move_alloc(self%bundles(i)%documents, longer(i)%documents)
         longer(i)%start = self%bundles(i)%start
      end do
      longer(size(longer)) = bundle
      call move_alloc(longer, self%bundles)
   end subroutine add_bundle

end module plydyn_base_archive
