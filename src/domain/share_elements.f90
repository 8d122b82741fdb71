!> Quads, interfaces and bricks of one rank, cut out of those of the whole model.
module plydyn_domain_share_elements
   use plydyn_base_precision, only : lanes
   use plydyn_domain_domain, only : chunk_type, domain_type
   use plydyn_domain_numbering, only : numbering_type
   use plydyn_element_brick, only : bricks_type
   use plydyn_element_interface, only : history_size, interface_type
   use plydyn_element_plate, only : plate_type, quad_histories
   implicit none
   private

   public :: take_bricks, take_interfaces, take_plates

contains

   !> Plates with the quads of the domain's chunks
   pure subroutine take_plates(whole, numbering, domain, history)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> Has its chunks, still with the quads of the whole model, and how many histories there are
      !> before; gets plates
      type(domain_type), intent(inout) :: domain
      !> Gets the pieces of history, as in `share_type`
      integer, allocatable, intent(inout) :: history(:, :)

      integer, allocatable :: quads(:)
      integer :: b, p

      do p = 1, size(whole%plates)
         quads = quads_of(domain%chunks, p)
         call cut_plate(whole%plates(p), quads, numbering, domain%plates(p))
         do b = 1, size(domain%plates(p)%batches)
            associate (batch => domain%plates(p)%batches(b))
               batch%first_history = domain%histories + 1
               call place_pieces(quads, quad_histories(batch, domain%plates(p)%side), &
                  & whole%plates(p)%batches(b)%first_history, domain%histories, history)
            end associate
         end do
      end do
   end subroutine take_plates

   !> Quads, or batches of bricks, of some chunks
   pure function quads_of(chunks, plate) result(quads)
      type(chunk_type), intent(in) :: chunks(:)
      !> The plate, or the bricks
      integer, intent(in) :: plate
      integer, allocatable :: quads(:)
      integer :: c, e

      allocate (quads(0))
      do c = 1, size(chunks)
         if (chunks(c)%plate /= plate) cycle
         quads = [quads, (e, e=chunks(c)%quads(1), chunks(c)%quads(2))]
      end do
   end function quads_of

   !> Some quads of a plate
   pure subroutine cut_plate(whole, quads, numbering, plate)
      type(plate_type), intent(in) :: whole
      integer, intent(in) :: quads(:)
      type(numbering_type), intent(in) :: numbering
      type(plate_type), intent(inout) :: plate

      plate%quad = whole%quad(quads)
      plate%last = [size(quads)]
      plate%node = renumbered(numbering, whole%node(:, quads))
      plate%target = renumbered(numbering, whole%target(:, quads))
      plate%metric = whole%metric(:, :, quads)
   end subroutine cut_plate

   !> Numbers of some columns
   pure function renumbered(numbering, column) result(number)
      type(numbering_type), intent(in) :: numbering
      integer, intent(in) :: column(:, :)
      integer :: number(size(column, 1), size(column, 2))
      integer :: e

      do e = 1, size(column, 2)
         number(:, e) = numbering%column(column(:, e))
      end do
   end function renumbered

   !> Let the histories of some elements follow those before them
   pure subroutine place_pieces(elements, length, whole_first, histories, history)
      !> The elements as the whole model has them
      integer, intent(in) :: elements(:)
      !> Histories of an element, and the place of the first element's in the whole model
      integer, intent(in) :: length, whole_first
      !> How many histories there are before, and with them
      integer, intent(inout) :: histories
      !> The pieces
      integer, allocatable, intent(inout) :: history(:, :)

      integer, allocatable :: pieces(:, :)
      integer :: e, n

      if (length == 0) return
      allocate (pieces(3, size(history, 2) + size(elements)))
      n = size(history, 2)
      pieces(:, :n) = history
      do e = 1, size(elements)
         associate (first => whole_first + length*(elements(e) - 1))
            if (n > 0 .and. e > 1) then
               if (pieces(2, n) + pieces(3, n) == first) then
                  pieces(3, n) = pieces(3, n) + length
                  histories = histories + length
                  cycle
               end if
            end if
            n = n + 1
            pieces(:, n) = [histories + 1, first, length]
         end associate
         histories = histories + length
      end do
      history = pieces(:, :n)
   end subroutine place_pieces

   !> Interfaces with the quads of the plates
   pure subroutine take_interfaces(whole, numbering, domain, history)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> As in `take_plates`; gets interfaces
      type(domain_type), intent(inout) :: domain
      !> Gets the pieces of history, as in `share_type`
      integer, allocatable, intent(inout) :: history(:, :)

      integer, allocatable :: quads(:)
      integer :: k

      do k = 1, size(whole%interfaces)
         quads = quads_of(domain%chunks, whole%interfaces(k)%plate)
         associate (all => whole%interfaces(k), some => domain%interfaces(k))
            some%quad = all%quad(quads)
            some%node = renumbered(numbering, all%node(:, quads))
            some%target = renumbered(numbering, all%target(:, quads))
            some%metric = all%metric(:, :, quads)
            some%first_history = domain%histories + 1
            call place_pieces(quads, lanes*some%law%histories*size(all%node, 1), &
               & all%first_history, domain%histories, history)
         end associate
      end do
   end subroutine take_interfaces

   !> Bricks of the domain's chunks
   pure subroutine take_bricks(whole, numbering, domain, history)
      !> The whole model
      type(domain_type), intent(in) :: whole
      !> The rank's numbers of columns
      type(numbering_type), intent(in) :: numbering
      !> As in `take_plates`; gets bricks
      type(domain_type), intent(inout) :: domain
      !> Gets the pieces of history, as in `share_type`
      integer, allocatable, intent(inout) :: history(:, :)

      integer, allocatable :: batches(:)
      integer :: p

      do p = 1, size(whole%bricks)
         batches = quads_of(domain%chunks, p)
         call cut_bricks(whole%bricks(p), batches, numbering, domain%bricks(p))
         associate (some => domain%bricks(p))
            some%first_history = domain%histories + 1
            call place_pieces(batches, lanes*some%histories*some%points, &
               & whole%bricks(p)%first_history, domain%histories, history)
         end associate
      end do
   end subroutine take_bricks

   !> Some batches of bricks
   pure subroutine cut_bricks(whole, batches, numbering, bricks)
      type(bricks_type), intent(in) :: whole
      integer, intent(in) :: batches(:)
      type(numbering_type), intent(in) :: numbering
      type(bricks_type), intent(inout) :: bricks

      integer :: b, e, i

      bricks%brick = [integer ::]
      do b = 1, size(batches)
         bricks%brick = [bricks%brick, (whole%brick(i), i=lanes*(batches(b) - 1) + 1, &
            & min(lanes*batches(b), size(whole%brick)))]
      end do
      bricks%place = whole%place(:, :, batches)
      bricks%target = whole%target(:, :, batches)
      do b = 1, size(batches)
         do e = 1, size(whole%place, 2)
            bricks%place(:, e, b) = numbering%place(bricks%place(:, e, b))
            bricks%target(:, e, b) = numbering%place(bricks%target(:, e, b))
         end do
      end do
      bricks%shape = whole%shape(batches)
   end subroutine cut_bricks

end module plydyn_domain_share_elements
