!> Materials have the constants of their cards, if these are possible.
program test_input_material
   use decks, only : plate, read_lines, with_material
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_model_model, only : model_type
   use testing, only : begin, check, check_error, finish
   implicit none

   character(*), parameter :: path = "test_input_material.k"
   type(model_type) :: model
   type(error_type), allocatable :: error
   character(:), allocatable :: messages

   call begin("read_mat_elastic")
   call read_plate("")
   associate (material => model%materials(1))
      call check(material%density, 1.6e-9_wp, 0.0_wp, "density")
      call check(material%law%young, [1.4e5_wp, 1.0e4_wp, 1.0e4_wp], 0.0_wp, "Young's moduli")
      call check(material%law%poisson, [0.3_wp, 0.3_wp, 0.45_wp], 0.0_wp, "Poisson's ratios")
      call check(material%law%shear, [5000.0_wp, 4000.0_wp, 3500.0_wp], 0.0_wp, "G12, G13, G23")
      call check(material%keyword == "MAT_PLY_ELASTIC", "keyword")
   end associate

   call begin("read_mat_elastic")
   call read_with("*MAT_ELASTIC_TITLE|steel|5,7.8e-9,2.6e5,0.3|")
   call check(.not. allocated(error), "is read")
   call check(model%materials(1)%law%shear, spread(1.0e5_wp, 1, 3), 1.0e-9_wp, "G = E/2(1 + nu)")
   call check(model%materials(1)%title == "steel", "title")
   call read_with("*MAT_001|5,7.8e-9,2.6e5,0.5|")
   call check_error(error, "PR cannot be 0.5", "an incompressible material")

   call begin("read_mat_orthotropic_elastic")
   call read_with("*MAT_ORTHOTROPIC_ELASTIC|5,1.6e-9,1.4e5,1.0e4,7.0e3,0.02,0.01,0.3|" &
      & //"5000.,3500.,4000.,2.0|0.,0.,0.,1.0,1.0,0.|0.,0.,0.,0.,1.0,0.|")
   call check(.not. allocated(error), "is read")
   associate (material => model%materials(1))
      call check(material%law%poisson, [0.28_wp, 0.2_wp, 0.3_wp/0.7_wp], 1.0e-14_wp, &
         & "nu_ij = nu_ji E_i/E_j")
      call check(material%law%shear, [5000.0_wp, 4000.0_wp, 3500.0_wp], 0.0_wp, "GAB, GCA, GBC")
      call check(material%axis_angle, 45.0_wp, 1.0e-12_wp, "axis angle from a")
   end associate
   call check(model%parts(1)%plies%angle, [45.0_wp, 135.0_wp, 45.0_wp], 1.0e-12_wp, &
      & "which the angles of plies are measured from")

   call begin("check_stability")
   call read_with("*MAT_PLY_ELASTIC|5,1.6e-9,1.4e5,1.0e4,1.0e4,3.73,0.,0.|5000.,4000.,3500.|")
   call check(.not. allocated(error), "a Poisson's ratio just below its bound is possible")
   call read_with("*MAT_PLY_ELASTIC|5,1.6e-9,1.4e5,1.0e4,1.0e4,3.75,0.,0.|5000.,4000.,3500.|")
   call check_error(error, "nu12 = 3.75 is too large", "one above it is not")
   call read_with("*MAT_PLY_ELASTIC|5,1.6e-9,1.0e4,1.0e4,1.0e4,0.6,0.6,0.6|5000.,4000.,3500.|")
   call check_error(error, "the three Poisson's ratios together", "nor are three large ones")

   call finish()

contains

   !> Write the plate and some more lines, parted by bars, and read it all
   subroutine read_plate(more)
      !> Lines behind those of the plate
      character(*), intent(in) :: more

      call read_lines(path, plate//more//"*END", model, messages, error)
   end subroutine read_plate

   !> Read the plate with another material
   subroutine read_with(material)
      !> Lines of the material
      character(*), intent(in) :: material

      call read_lines(path, with_material(material), model, messages, error)
   end subroutine read_with

end program test_input_material
