!> Chunks of bricks: what a thread takes at a time; see `plydyn_domain_chunks`.
module plydyn_domain_brick_chunks
   use plydyn_domain_columns, only : front
   use plydyn_domain_domain, only : chunk_type, domain_type
   implicit none
   private

   public :: new_brick_chunks

   !> Most batches of a chunk
   integer, parameter :: most_batches = 256

contains

   !> All chunks of a domain of bricks, and the columns that take their forces
   subroutine new_brick_chunks(domain)
      !> Bricks get their targets, the domain its chunks, and its columns their size
      type(domain_type), intent(inout) :: domain

      integer :: batches, c, first, p

      allocate (domain%chunks(sum([((size(domain%bricks(p)%shape) + most_batches - 1) &
         & /most_batches, p=1, size(domain%bricks))])))
      c = 0
      do p = 1, size(domain%bricks)
         batches = size(domain%bricks(p)%shape)
         do first = 1, batches, most_batches
            c = c + 1
            domain%chunks(c)%plate = p
            domain%chunks(c)%quads(:) = [first, min(first + most_batches - 1, batches)]
         end do
      end do
      call set_targets(domain)
   end subroutine new_brick_chunks

   !> Give every column of every chunk itself, or the next behind that it has
   subroutine set_targets(domain)
      type(domain_type), intent(inout) :: domain

      integer :: chunks_at(domain%columns%count), next(domain%columns%count)
      integer :: behind(domain%columns%count), c, columns, i, own

      chunks_at(:) = 0
      do c = 1, size(domain%chunks)
         call find_columns(domain, domain%chunks(c))
         chunks_at(domain%chunks(c)%column) = chunks_at(domain%chunks(c)%column) + 1
      end do
      columns = domain%columns%count
      behind(:) = 0
      allocate (domain%borders(3, count(chunks_at > 1)))
      domain%borders(1, :) = pack([(i, i=1, size(chunks_at))], chunks_at > 1)
      do i = 1, size(domain%borders, 2)
         behind(domain%borders(1, i)) = columns + 1
         domain%borders(2, i) = columns + 1
         columns = columns + chunks_at(domain%borders(1, i)) - 1
         domain%borders(3, i) = columns
      end do
      domain%columns%forces = front + domain%columns%height*columns
      next(:) = [(i, i=1, size(next))]
      do c = 1, size(domain%chunks)
         call shift_targets(domain, domain%chunks(c), next)
         do i = 1, size(domain%chunks(c)%column)
            own = domain%chunks(c)%column(i)
            domain%chunks(c)%column(i) = next(own)
            next(own) = merge(behind(own), next(own) + 1, next(own) == own)
         end do
      end do
   end subroutine set_targets

   !> Columns of a chunk, each once
   subroutine find_columns(domain, chunk)
      type(domain_type), intent(in) :: domain
      type(chunk_type), intent(inout) :: chunk

      logical :: touched(domain%columns%count)
      integer :: b, i, n

      touched(:) = .false.
      associate (place => domain%bricks(chunk%plate)%place, height => domain%columns%height)
         do b = chunk%quads(1), chunk%quads(2)
            do n = 1, size(place, 2)
               touched(1 + (place(:, n, b) - front - 1)/height) = .true.
            end do
         end do
      end associate
      chunk%column = pack([(i, i=1, size(touched))], touched)
   end subroutine find_columns

   !> Move the targets of a chunk to the columns that are next
   subroutine shift_targets(domain, chunk, next)
      type(domain_type), intent(inout) :: domain
      type(chunk_type), intent(in) :: chunk
      integer, intent(in) :: next(:)

      integer :: b, n

      associate (target => domain%bricks(chunk%plate)%target, height => domain%columns%height, &
         & place => domain%bricks(chunk%plate)%place)
         do b = chunk%quads(1), chunk%quads(2)
            do n = 1, size(target, 2)
               target(:, n, b) = front + 1 + mod(place(:, n, b) - front - 1, height) &
                  & + height*(next(1 + (place(:, n, b) - front - 1)/height) - 1)
            end do
         end do
      end associate
   end subroutine shift_targets

end module plydyn_domain_brick_chunks
