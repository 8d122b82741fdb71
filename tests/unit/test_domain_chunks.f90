!> Chunks of quads and the columns that take their forces.
program test_domain_chunks
   use ball, only : ball_body
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_chunks, only : divide_quads, list_chunks
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_body, only : contact_type, impactor_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : top_face
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   call test_division()
   call test_targets()
   call test_contributors()
   call test_face()
   call finish()

contains

   !> A strip of 64 by 8 squares falls into chunks of 4 by 2 or 2 by 4
   subroutine test_division()
      integer, allocatable :: last(:), order(:)
      real(wp) :: centre(2, 512), extent(2)
      integer :: first, i, k

      call begin("divide_quads")
      do i = 1, 512
         centre(:, i) = [real(mod(i - 1, 64), wp), real((i - 1)/64, wp)]
      end do
      call divide_quads(centre, order, last)
      call check(all([(count(order == i), i=1, 512)] == 1), "every quad has one place")
      call check(size(last), 64, "there are as few chunks as can be")
      first = 1
      do k = 1, size(last)
         extent(:) = maxval(centre(:, order(first:last(k))), 2) &
            & - minval(centre(:, order(first:last(k))), 2)
         call check(last(k) - first + 1, 8, "a chunk has 8 quads")
         call check(sum(extent), 4.0_wp, 1.0e-12_wp, "side by side")
         first = last(k) + 1
      end do
   end subroutine test_division

   !> No two chunks share a column, and every node finds all that belong to it
   subroutine test_targets()
      type(domain_type) :: domain
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      integer, allocatable :: begun(:), node_of(:), summed(:), taken(:)
      integer :: c, e, i

      call begin("new_chunks")
      call build_domain(rectangle_model(rectangle_mesh(3, 9, 7, 9.0_wp, 7.0_wp, 0.0_wp), &
         & [0.0_wp, 90.0_wp], 0.25_wp, [2, 2]), domain, error)
      plate = plate_of(domain, 1)
      call check(.not. allocated(error), "the domain is built")
      allocate (taken(domain%columns%forces/domain%columns%height))
      allocate (node_of(size(taken)))
      node_of(:) = [(i, i=1, size(node_of))]
      do i = 1, size(domain%chunks%shared_nodes, 2)
         node_of(domain%chunks%shared_nodes(2, i):domain%chunks%shared_nodes(3, i)) = &
            & domain%chunks%shared_nodes(1, i)
      end do
      allocate (begun, mold=node_of)
      begun(:) = 0
      taken(:) = 0
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c))
            taken(chunk%column) = taken(chunk%column) + 1
            do e = chunk%elements(1), chunk%elements(2)
               call check(all(node_of(abs(plate%target(:, e))) == plate%node(:, e)), &
                  & "forces go to a column of their node")
               call check(all([(any(chunk%column == abs(plate%target(i, e))), i=1, 9)]), &
                  & "and of their chunk")
               do i = 1, 9
                  associate (column => abs(plate%target(i, e)))
                     call check((begun(column) == 0) .eqv. plate%target(i, e) < 0, &
                        & "the first quad at a column begins it")
                     begun(column) = begun(column) + 1
                  end associate
               end do
            end do
         end associate
      end do
      call check(all(taken == 1), "every column belongs to one chunk")
      summed = [integer ::]
      do c = 1, size(domain%chunks%list)
         associate (chunk => domain%chunks%list(c))
            summed = [summed, chunk%shared_nodes]
            call check(all([(any(chunk%owned_columns == domain%chunks%shared_nodes(1, &
               & chunk%shared_nodes(i))), &
               & i=1, size(chunk%shared_nodes))]), "a chunk adds up borders at its own nodes")
         end associate
      end do
      call check(all([(count(summed == i), i=1, size(domain%chunks%shared_nodes, 2))] == 1), &
         & "every border is added up once")
   end subroutine test_targets

   !> A chunk needs the forces of all chunks with a quad at one of its nodes
   subroutine test_contributors()
      type(domain_type) :: domain
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      integer :: c, i, k
      logical :: meets

      call begin("find_contributors")
      call build_domain(rectangle_model(rectangle_mesh(3, 9, 7, 9.0_wp, 7.0_wp, 0.0_wp), &
         & [0.0_wp], 0.25_wp, [1]), domain, error)
      plate = plate_of(domain, 1)
      do c = 1, size(domain%chunks%list)
         do k = 1, size(domain%chunks%list)
            associate (own => domain%chunks%list(c)%owned_columns, &
               & contributors => domain%chunks%list(c)%contributors, &
               & quads => domain%chunks%list(k)%elements)
               meets = any([(any(plate%node(:, quads(1):quads(2)) == own(i)), &
                  & i=1, size(own))])
               call check(count(contributors == k), merge(1, 0, meets), "each that meets it, once")
            end associate
         end do
      end do
   end subroutine test_contributors

   !> The chunks at a facet are those with a quad at one of its nodes
   subroutine test_face()
      type(domain_type) :: domain
      type(plate_type) :: plate
      type(error_type), allocatable :: error
      type(model_type) :: model
      integer, allocatable :: last(:), list(:)
      integer :: f, i, k
      logical :: meets

      call begin("list_chunks")
      model = rectangle_model(rectangle_mesh(3, 9, 7, 9.0_wp, 7.0_wp, 0.0_wp), [0.0_wp], 0.25_wp, &
         & [1])
      model%impactors = [impactor_type(id=1, kind="sphere", &
         & body=ball_body(8.0_wp), mass=1.0_wp, centre=[4.0_wp, 3.0_wp, 9.0_wp])]
      model%contacts = [contact_type(id=1, impactor=1, parts=[1], face=top_face)]
      call build_domain(model, domain, error)
      plate = plate_of(domain, 1)
      call check(.not. allocated(error), "the domain is built")
      associate (surface => domain%contact%surfaces(1))
         call list_chunks(domain, surface, last, list)
         do f = 1, size(surface%facet, 2)
            do k = 1, size(domain%chunks%list)
               associate (node => surface%node(surface%facet(:, f)), &
                  & quads => domain%chunks%list(k)%elements)
                  meets = any([(any(plate%node(:, quads(1):quads(2)) == node(i)), &
                     & i=1, size(node))])
                  call check(count(list(last(f - 1) + 1:last(f)) == k), merge(1, 0, meets), &
                     & "each that meets it, once")
               end associate
            end do
         end do
      end associate
   end subroutine test_face

end program test_domain_chunks
