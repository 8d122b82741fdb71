!> Points that a base pushes: they lie in chunks that wait for contact, and no others wait.
program test_method_fixture_step
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_contact_bodies_flat_body, only : flat_body_type, rectangle_outline
   use plydyn_contact_search_near_points, only : unknown_move
   use plydyn_method_energy, only : global_reduction_type
   use plydyn_model_body, only : fixture_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : bottom_face
   use plydyn_parallel_comm, only : comm_type
   use plydyn_run_setup, only : run_type, set_up
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Sides of the plate and of the window below it; how fast it falls
   real(wp), parameter :: length = 24.0_wp, width = 12.0_wp, speed = 10.0_wp
   type(run_type) :: plate

   call make_plate()
   call check_chunks()
   call finish()

contains

   !> A plate of 24 by 12 quads that falls on a base with a window
   subroutine make_plate()
      type(error_type), allocatable :: error
      type(comm_type) :: alone
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(2, 24, 12, length, width, 0.0_wp), &
         & [0.0_wp, 90.0_wp], 0.25_wp, [1, 1])
      model%fixtures = [fixture_type(id=1, kind="base", face=bottom_face, body=flat_body_type( &
         & upward=1, edge=0.1_wp, outlines=[rectangle_outline(0.5_wp*[length, width], &
         & [length - 4.0_wp, width - 4.0_wp], 0.0_wp, .true.)]))]
      plate%model = model
      call set_up(alone, plate, error)
      call begin("set_up")
      call check(.not. allocated(error), "a plate on a base")
   end subroutine make_plate

   !> Steps of a plate that falls as one body: in the first its speed has no bound, in the second
   !> the points near the base are listed, and from then on the list lasts
   subroutine check_chunks()
      type(global_reduction_type) :: reduction
      logical, allocatable :: moved(:), reached(:)
      integer :: step

      call begin("correct")
      allocate (moved, reached, mold=plate%contacts%reached)
      call reduction%expect_bodies(plate%domain%contact)
      plate%state%step = plate%domain%step
      plate%state%step_before = plate%domain%step
      do step = 1, 6
         reached(:) = plate%contacts%reached
         call fall(reduction, moved)
         call check(plate%contacts%reaches_all .or. all(reached .or. .not. moved), &
            & "what is pushed lies in chunks that wait")
         if (step == 1) call check(plate%contacts%reaches_all, "all wait before the first list")
         if (step < 3) cycle
         call check(.not. plate%contacts%reaches_all, "only some chunks wait")
         call check(any(moved), "the base pushes points")
         call check(.not. all(reached), "chunks over the window go on")
      end do
      reduction%speed_bound = huge(1.0_wp)
      call plate%contacts%predict(plate%domain, reduction, plate%state)
      call check(plate%contacts%reaches_all, "all wait where the speed of points has no bound")
      call check(plate%contacts%near(1)%reach >= unknown_move, "and all points are looked at")
   end subroutine check_chunks

   !> A step in which all points fall, and the chunks whose points the base pushes
   subroutine fall(reduction, moved)
      type(global_reduction_type), intent(inout) :: reduction
      logical, intent(out) :: moved(:)

      real(wp), allocatable :: before(:)
      integer :: c, k, place

      associate (state => plate%state, domain => plate%domain)
         call plate%contacts%predict(domain, reduction, state)
         call reduction%clear()
         associate (face => domain%contact%fixture_faces(domain%contact%fixtures(1)%surface))
            do k = 1, size(face%freedom, 2)
               state%velocity(face%freedom(3, k)) = -speed
               place = face%freedom(3, k)
               state%displacement(place) = state%displacement(place) - state%step*speed
            end do
            before = state%displacement
            call plate%contacts%correct(domain, state, reduction)
            reduction%speed_bound = speed
            do c = 1, size(moved)
               moved(c) = any([(abs(state%displacement(face%freedom(3, k)) &
                  & - before(face%freedom(3, k))) > 0.0_wp .and. any(domain%chunks%list(c)%column &
                  & == domain%columns%column_of(face%freedom(3, k))), k=1, size(face%freedom, 2))])
            end do
         end associate
      end associate
   end subroutine fall

end program test_method_fixture_step
