!> An impactor in free flight touches the plate where and when its parabola meets it.
program test_model_approach
   use ball, only : ball_body
   use plydyn_base_precision, only : wp
   use plydyn_model_approach, only : approach_type, find_approach
   use plydyn_model_body, only : contact_type, impactor_type
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : bottom_face, top_face
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   implicit none

   !> Half of the side of the plate; its thickness, above its nodes; radius of the ball
   real(wp), parameter :: half = 10.0_wp, thick = 1.0_wp, radius = 2.0_wp
   !> Way to the plate, and how near to it the ball counts as there
   real(wp), parameter :: way = 3.0_wp, near = 1.0e-6_wp*radius
   type(model_type) :: model
   type(approach_type) :: found

   model = rectangle_model(rectangle_mesh(2, 4, 4, 2.0_wp*half, 2.0_wp*half, 0.0_wp), &
      & [0.0_wp, 0.0_wp], 0.5_wp*thick, [1, 1])
   model%parts(1)%bottom_offset = 0.0_wp
   model%control%end_time = 1.0_wp

   call begin("find_approach")
   found = flight([half, half, thick + radius + way], [0.0_wp, 0.0_wp, -10.0_wp], 0.0_wp, top_face)
   call check(found%is_known .and. found%arrives .and. .not. found%is_at_edge, "meets the face")
   call check(found%time, way/10.0_wp, near/10.0_wp, "when it has gone the way to it")
   call check(found%distance, way, near, "whose length it gives")
   call check(found%centre, [half, half, thick + radius], near, "a radius above the face")

   found = flight([half, half, -radius - way], [4.0_wp, 0.0_wp, 10.0_wp], 0.0_wp, bottom_face)
   call check(found%arrives, "meets the bottom face, too")
   call check(found%distance, way*sqrt(1.16_wp), 2.0_wp*near, "on a slanted way")
   call check(found%centre, [half + 0.4_wp*way, half, -radius], near, "to a place beside its own")

   found = flight([half, half, thick + radius + way], [0.0_wp, 0.0_wp, -2.0_wp], 0.0_wp, top_face)
   call check(.not. found%arrives, "comes too late when it is slow")
   call check([found%time, found%distance], [1.0_wp, 2.0_wp], 1.0e-12_wp, "and is on its way then")

   found = flight([half, half, thick + radius + way], [0.0_wp, 0.0_wp, 0.0_wp], -24.0_wp, top_face)
   call check(found%arrives, "falls")
   call check(found%time, 0.5_wp, near, "for the root of twice the way over the weight")

   found = flight([-3.0_wp, half, thick + radius + way], [0.0_wp, 0.0_wp, -10.0_wp], 0.0_wp, &
      & top_face)
   call check(.not. found%arrives, "passes beside the plate")
   call check(found%distance, 10.0_wp, 1.0e-12_wp, "all the way")

   model%impactors(1)%motion(3) = 1
   found = find_approach(model, model%contacts(1))
   call check(.not. found%is_known, "is not known where the motion is given")
   call finish()

contains

   !> The first touch of a ball
   function flight(centre, velocity, weight, face) result(approach)
      !> At time zero
      real(wp), intent(in) :: centre(3), velocity(3)
      !> Acceleration along z
      real(wp), intent(in) :: weight
      integer, intent(in) :: face
      type(approach_type) :: approach

      model%impactors = [impactor_type(id=1, kind="", body=ball_body(radius), &
         & centre=centre, velocity=velocity, gravity=[0.0_wp, 0.0_wp, weight])]
      model%impactors(1)%body%axis(3) = real(face, wp)
      model%contacts = [contact_type(impactor=1, parts=[integer ::], face=face)]
      approach = find_approach(model, model%contacts(1))
   end function flight

end program test_model_approach
