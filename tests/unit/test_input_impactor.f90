!> Impactors, contacts and output requests are as on their cards.
program test_input_impactor
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_body, only : nodes_on_impactor, points_on_plate
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : prescribes_displacement
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_impactor.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages
   character(*), parameter :: ball = &
      & "*IMPACTOR_SPHERE_TITLE|ball|2,5.,1.e-3,0.5,0.5,6.|0.,0.,-3.e3,"

   call begin("read_impactor, read_contact_impactor")
   call read_plate(ball//"1,-9810.,1|*CONTACT_IMPACTOR|1,2,7,1,2,0.5|0.,0.,0.|")
   call check(.not. allocated(error), "are read")
   associate (impactor => model%impactors(1), contact => model%contacts(1))
      call check(impactor%id, 2, "number behind a title")
      call check([impactor%body%radius, impactor%mass], [5.0_wp, 1.0e-3_wp], 0.0_wp, &
         & "radius and mass")
      call check(impactor%centre, [0.5_wp, 0.5_wp, 6.0_wp], 0.0_wp, "centre")
      call check(impactor%velocity, [0.0_wp, 0.0_wp, -3000.0_wp], 0.0_wp, "velocity")
      call check(impactor%guided, "guided")
      call check(impactor%inverse_mass(), [0.0_wp, 0.0_wp, 1.0e3_wp], 1.0e-12_wp, &
         & "gives way along its guide alone")
      call check(impactor%inverse_inertia(), 0.0_wp, 0.0_wp, "does not turn in a guide")
      call check(impactor%body%axis, [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, "its back looks away")
      call check(impactor%gravity(3), -9810.0_wp, 0.0_wp, "gravity")
      call check(contact%impactor == 1 .and. all(contact%parts == [1]), "references by index")
      call check(contact%method, points_on_plate, "method")
      call check(contact%spacing, 0.5_wp, 0.0_wp, "spacing")
   end associate
   call read_plate(ball//"|*CONTACT_IMPACTOR|1,2,7,1|")
   call check(.not. allocated(error), "the second card of a contact may be missing")
   call check(model%contacts(1)%method, nodes_on_impactor, "usual method")
   call read_plate("*IMPACTOR_SPHERE|2,5.,1.e-3,0.5,0.5,6.|1.,0.,-3.e3,1|" &
      & //"*CONTACT_IMPACTOR|1,2,7,1|")
   call check_error(error, "a guided impactor moves along z only", "a guided one that drifts")

   call begin("read_impactor, motion")
   call read_plate("*DEFINE_CURVE|9,|0.,0.|1.,-1.|*IMPACTOR_SPHERE|2,5.,1.e-3,0.5,0.5,6.|" &
      & //"0.,0.,0.|0.02,1.,2.,0,0,9,2|*CONTACT_IMPACTOR|1,2,7,1|0.3,0.2,1.e-3|")
   call check(.not. allocated(error), "is read")
   associate (impactor => model%impactors(1), friction => model%contacts(1)%friction)
      call check(impactor%rotates .and. .not. impactor%guided, "a free ball rotates")
      call check(impactor%inertia, 0.02_wp, 0.0_wp, "moment of inertia")
      call check(impactor%inverse_inertia(), 50.0_wp, 1.0e-12_wp, "turns")
      call check(impactor%inverse_mass(), [1.0e3_wp, 1.0e3_wp, 0.0_wp], 1.0e-12_wp, &
         & "gives no way where a curve leads it")
      call check(impactor%gravity, [1.0_wp, 2.0_wp, 0.0_wp], 0.0_wp, "weight")
      call check(all(impactor%motion == [0, 0, 1]), "curves")
      call check(impactor%quantity, prescribes_displacement, "what they give")
      call check([friction%static, friction%dynamic, friction%decay], &
         & [0.3_wp, 0.2_wp, 1.0e-3_wp], 0.0_wp, "friction")
   end associate
   call read_plate(ball//"2|*CONTACT_IMPACTOR|1,2,7,1|")
   associate (impactor => model%impactors(1))
      call check(.not. (impactor%rotates .or. impactor%guided), "free to move, not to rotate")
      call check(impactor%inertia, 0.4_wp*1.0e-3_wp*25.0_wp, 1.0e-15_wp, "inertia of a solid ball")
   end associate

   call begin("output")
   call read_plate("*DATABASE_HISTORY_NODE|4,2|2,|*SET_NODE_LIST|1,|1,2|" &
      & //"*DATABASE_HISTORY_NODE_SET|1,|*DATABASE_NODOUT|0.1,|" &
      & //"*DATABASE_FIELD|strain, Stress_Ply|velocity|" &
      & //"*DATABASE_PROFILE|3,0.1,0.2,7,0.5|*DATABASE_GLSTAT|0.2,1,0,1|*DATABASE_SPCFORC|0.3,|" &
      & //"*DATABASE_IMPACTOR|0.4,|*DATABASE_BINARY_D3PLOT|0.5,|")
   call check(.not. allocated(error), "requests are read")
   associate (request => model%request)
      call check(all(request%nodes == [4, 2, 1]), "nodes once")
      call check(all(request%fields == [character(10) :: "strain", "stress_ply", "velocity"]), &
         & "fields in small letters")
      call check([request%energy_interval, request%node_interval, request%support_interval, &
         & request%impactor_interval, request%field_interval], &
         & [0.2_wp, 0.1_wp, 0.3_wp, 0.4_wp, 0.5_wp], 0.0_wp, "intervals")
      call check(request%profiles(1)%position, [0.1_wp, 0.2_wp], 0.0_wp, "place of a profile")
      call check(request%profiles(1)%points, 7, "points of a profile")
   end associate
   call read_plate("")
   call check(all(model%request%fields == [character(12) :: "displacement", "velocity", &
      & "stress"]), "usual fields")
   call check(model%request%field_interval, 0.05_wp, 1.0e-15_wp, "twenty states")

   call begin("read_database_field")
   call read_plate("*DATABASE_FIELD|plastic_strain|")
   call check_error(error, "no material yields", "plastic strain needs a material that yields")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_impactor
