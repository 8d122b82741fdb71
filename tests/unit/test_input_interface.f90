!> Interfaces have the material and the options of their cards.
program test_input_interface
   use decks, only : plate, read_lines
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_law_cohesive_softening, only : benzeggagh_kenane, power_law
   use plydyn_model_layup, only : faces_apart
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   !> A bond, and one whose strengths follow from ultimate displacements
   character(*), parameter :: bond = "*MAT_COHESIVE_MIXED_MODE|6,0.,0,0,3.0e5,2.0e5,0.28,0.79|" &
      & //"-1.6,60.,90.|"
   character(*), parameter :: path = "test_input_interface.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_interface_cohesive")
   call read_plate("*MAT_COHESIVE_ELASTIC|6,0.,0,0,2.0e5,3.0e5|*INTERFACE_COHESIVE|7,1,1,6|" &
      & //"7,2,2,-1|")
   call check(.not. allocated(error), "is read")
   call check(all(model%parts(1)%joint == [1, faces_apart]), "springs and nothing")
   call read_plate("*INTERFACE_COHESIVE|7,0,0,-1|7,2,2,-1|")
   call check_error(error, "have a card already", "an interface twice")
   call read_plate("*INTERFACE_COHESIVE|7,2,3,-1|")
   call check_error(error, "interfaces 2 to 3 do not exist", "an interface that is none")
   call read_plate("*INTERFACE_COHESIVE|7,1,1,0|")
   call check_error(error, "MID cannot be 0", "a tied one")

   call begin("options of an interface")
   call read_plate(bond//"*INTERFACE_COHESIVE|7,1,1,6|7,2,2,6,1,1,0.3,3|")
   call check(.not. allocated(error), "are read")
   associate (plain => model%interface_materials(model%parts(1)%joint(1)), &
      & other => model%interface_materials(model%parts(1)%joint(2)))
      call check(plain%id == 6 .and. other%id == 6, "both are of one material")
      call check(plain%constants%falling_penalty .and. .not. other%constants%falling_penalty, &
         & "the penalty falls unless it is to stay")
      call check(.not. plain%nodal .and. other%nodal, "points")
      call check([plain%constants%friction, other%constants%friction], [0.0_wp, 0.3_wp], 0.0_wp, &
         & "friction")
      call check(other%fitted .and. other%constants%consistent, "both are fitted")
      call check(.not. (plain%fitted .or. plain%constants%consistent), "nothing is fitted")
   end associate
   call read_plate(bond//"*INTERFACE_COHESIVE|7,0,0,6,0,0,0.3|")
   call check(model%parts(1)%joint(1) == model%parts(1)%joint(2), "alike ones share a material")
   call read_plate(bond//"*INTERFACE_COHESIVE|7,1,1,6,0,0,0.,1|7,2,2,6,0,0,0.,2|")
   associate (stiff => model%interface_materials(model%parts(1)%joint(1)), &
      & weak => model%interface_materials(model%parts(1)%joint(2)))
      call check(stiff%constants%consistent .and. .not. stiff%fitted, "1 fits the stiffness alone")
      call check(weak%fitted .and. .not. weak%constants%consistent, "2 fits the strengths alone")
   end associate
   call read_plate("*MAT_COHESIVE_ELASTIC|6,0.,0,0,2.0e5,3.0e5|*INTERFACE_COHESIVE|7,0,0,6,0,1|")
   call check_error(error, "CLOSE needs an interface that fails", "springs do not fail")
   call read_plate("*INTERFACE_COHESIVE|7,0,0,-1,0,0,0.,2|")
   call check_error(error, "FIT needs an interface that fails", "nothing does not fail")

   call begin("read_interface_law")
   call read_plate(bond//"*INTERFACE_LAW|6,1,0.74|*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "is read")
   associate (law => model%interface_materials(model%parts(1)%joint(2))%constants)
      call check(law%by_work, "mix of modes of the work")
      call check(law%pressure_gain, 0.74_wp, 0.0_wp, "shear strength over pressure")
   end associate
   call read_plate("*MAT_COHESIVE_ELASTIC|6,0.,0,0,2.0e5,3.0e5|*INTERFACE_LAW|6,1|" &
      & //"*INTERFACE_COHESIVE|7,0,0,6|")
   call check_error(error, "the material does not fail", "springs have no law of failure")

   call begin("read_mat_cohesive_elastic")
   call read_plate("*MAT_COHESIVE_ELASTIC|6,1.0e-9,0,0,2.0e5,3.0e5|*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "is read")
   call check(model%interface_materials(1)%constants%stiffness, [3.0e5_wp, 2.0e5_wp], 0.0_wp, &
      & "stiffness")
   call check(.not. model%interface_materials(1)%fails, "springs do not fail")
   call check(index(messages, "RO is without effect") > 0, "a density makes a note")

   call begin("read_mat_cohesive_mixed_mode")
   call read_plate(bond//"*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "is read")
   associate (constants => model%interface_materials(1)%constants)
      call check(model%interface_materials(1)%fails, "it fails")
      call check(constants%stiffness, [3.0e5_wp, 2.0e5_wp], 0.0_wp, "stiffness")
      call check(constants%toughness, [0.28_wp, 0.79_wp], 0.0_wp, "toughness")
      call check(constants%strength, [60.0_wp, 90.0_wp], 0.0_wp, "strength")
      call check(constants%criterion, benzeggagh_kenane, "XMU below 0 is Benzeggagh-Kenane")
      call check(constants%exponent, 1.6_wp, 0.0_wp, "exponent")
   end associate
   call read_plate("*MAT_138|6,0.,0,0,3.0e5,2.0e5,0.3,0.8|1.5,0.,0.,0.01,0.02,1.|" &
      & //"*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "ultimate displacements are read")
   associate (constants => model%interface_materials(1)%constants)
      call check(constants%strength, [60.0_wp, 80.0_wp], 1.0e-10_wp, "T = 2 GIC/UND, S likewise")
      call check(constants%criterion, power_law, "XMU above 0 is the power law")
   end associate
   call read_plate("*MAT_138|6,0.,0,0,3.0e5,2.0e5,0.3,0.8|1.5,60.,80.,0.,0.,2.|")
   call check_error(error, "GAMMA = 2 is not supported", "another exponent of the stiffness")

   call begin("read_mat_cohesive_general")
   call read_plate("*MAT_COHESIVE_GENERAL|6,0.,0,0,2,3,0.3,0.8|1.,60.,80.|*DEFINE_CURVE|3,|0.,0.|" &
      & //"0.1,1.|1.,0.|*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "is read")
   associate (constants => model%interface_materials(1)%constants)
      ! final separations 2 G/T and 2 G/S, a tenth of them at the peak
      call check(constants%stiffness, [60.0_wp/(0.1_wp*0.01_wp), 80.0_wp/(0.1_wp*0.02_wp)], &
         & 1.0e-8_wp, "stiffness from the triangle")
      call check(constants%strength, [60.0_wp, 80.0_wp], 0.0_wp, "strength")
      call check(constants%criterion, power_law, "the dimensionless separation is a power law")
      call check(constants%exponent, 1.0_wp, 0.0_wp, "of exponent 1")
   end associate
   call read_plate("*MAT_186|6,0.,0,0,0,3,0.3,0.8|1.,60.,80.|*DEFINE_CURVE|3,|0.,0.|" &
      & //"0.1,1.|1.,0.|*INTERFACE_COHESIVE|7,0,0,6|")
   call check_error(error, "TES 0 is not supported", "another separation")
   call read_plate("*MAT_186|6,0.,0,0,2.0,3,0.3,0.8|1.,60.,80.|*DEFINE_CURVE|3,|0.,0.|" &
      & //"0.1,1.|1.,0.|*INTERFACE_COHESIVE|7,0,0,6|")
   call check(.not. allocated(error), "TES 2.0, as other programs write it, is 2")
   call read_plate("*MAT_186|6,0.,0,0,1.5,3,0.3,0.8|1.,60.,80.|*DEFINE_CURVE|3,|0.,0.|" &
      & //"0.1,1.|1.,0.|*INTERFACE_COHESIVE|7,0,0,6|")
   call check_error(error, "'1.5' is not an integer", "TES 1.5 is none")
   call read_plate("*MAT_186|6,0.,0,0,2,3,0.3,0.8|1.,60.,80.|*DEFINE_CURVE|3,|0.,0.|" &
      & //"0.1,1.|0.5,1.|1.,0.|*INTERFACE_COHESIVE|7,0,0,6|")
   call check_error(error, "curve 3 is no triangle", "a plateau")
   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

end program test_input_interface
