!> Readers of materials.
module plydyn_input_read_material
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_cards, only : cards_type
   use plydyn_input_catalogue, only : a_material, catalogue_type
   use plydyn_law_constants, only : law_constants_type
   use plydyn_law_ply_orthotropic, only : elastic_constants_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: read_mat_elastic, read_mat_orthotropic_elastic, begin_material, check_stability, &
      & read_axes, read_isotropic, read_ply

   !> Poisson's ratio of an isotropic material lies between these
   real(wp), parameter :: least_poisson = -1.0_wp, most_poisson = 0.5_wp
   real(wp), parameter :: degrees = 180.0_wp/acos(-1.0_wp)

contains

   !> *MAT_ELASTIC, *MAT_PLY_ELASTIC: isotropic, or a ply by its engineering constants
   subroutine read_mat_elastic(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(elastic_constants_type) :: law
      type(material_type) :: material

      call begin_material(cards, catalogue, material)
      if (cards%name == "MAT_ELASTIC") then
         call read_isotropic(cards, catalogue, law)
      else
         call read_ply(cards, catalogue, law)
      end if
      call add_material(model%materials, material, law)
   end subroutine read_mat_elastic

   !> E and PR of an isotropic material
   subroutine read_isotropic(cards, catalogue, law)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its elastic constants
      class(law_constants_type), intent(inout) :: law

      real(wp) :: poisson

      poisson = cards%real("PR")
      law%young(:) = cards%real("E")
      law%poisson(:) = poisson
      if (poisson > least_poisson .and. poisson < most_poisson) then
         law%shear(:) = cards%real("E")/(2.0_wp*(1.0_wp + poisson))
      else
         call catalogue%refuse(cards, "PR", "PR cannot be "//text(poisson), &
            & "a number above -1 and below 0.5, or a strain would give energy")
      end if
   end subroutine read_isotropic

   !> Engineering constants of a ply in its own axes
   subroutine read_ply(cards, catalogue, law)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its elastic constants
      class(law_constants_type), intent(inout) :: law

      law%young(:) = cards%reals(["E1", "E2", "E3"])
      law%poisson(:) = cards%reals(["NU12", "NU13", "NU23"])
      law%shear(:) = cards%reals(["G12", "G13", "G23"])
      call check_stability(cards, ["NU12", "NU13", "NU23"], law, catalogue)
   end subroutine read_ply

   !> *MAT_ORTHOTROPIC_ELASTIC: a ply by its minor Poisson's ratios and its axes
   subroutine read_mat_orthotropic_elastic(cards, catalogue, model)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      type(model_type), intent(inout) :: model

      type(elastic_constants_type) :: law
      type(material_type) :: material
      real(wp) :: minor(3)

      call begin_material(cards, catalogue, material)
      law%young(:) = cards%reals(["EA", "EB", "EC"])
      law%shear(:) = cards%reals(["GAB", "GCA", "GBC"])
      minor(:) = cards%reals(["PRBA", "PRCA", "PRCB"])
      if (all(law%young > 0.0_wp)) then
         law%poisson(:) = minor*law%young([1, 1, 2])/law%young([2, 3, 3])
         call check_stability(cards, ["PRBA", "PRCA", "PRCB"], law, catalogue)
      end if
      call read_axes(cards, catalogue, material)
      call add_material(model%materials, material, law)
   end subroutine read_mat_orthotropic_elastic

   !> Direction of the axis a of a material whose vectors a and d lie in the plane of the plate
   subroutine read_axes(cards, catalogue, material)
      type(cards_type), intent(in) :: cards
      type(catalogue_type), intent(inout) :: catalogue
      !> Gets its axis angle
      type(material_type), intent(inout) :: material

      real(wp) :: a(2), d(2)

      if (.not. (cards%is_fine("A1") .and. cards%is_fine("A2") .and. cards%is_fine("D1") &
         & .and. cards%is_fine("D2"))) return
      a(:) = cards%reals(["A1", "A2"])
      d(:) = cards%reals(["D1", "D2"])
      if (a(1)*d(2) - a(2)*d(1) > 0.0_wp) then
         material%axis_angle = degrees*atan2(a(2), a(1))
      else if (norm2(a) <= 0.0_wp) then
         call catalogue%refuse(cards, "A1", "a is zero", "a vector in the plane of the plate")
      else
         call catalogue%refuse(cards, "D1", "d is not counter-clockwise from a", &
            & "a and d in the plane of the plate, d between 0 and 180 degrees from a")
      end if
   end subroutine read_axes

   !> Number, title and density of a ply material
   subroutine begin_material(cards, catalogue, material)
      !> The keyword
      type(cards_type), intent(in) :: cards
      !> Gets the number
      type(catalogue_type), intent(inout) :: catalogue
      type(material_type), intent(inout) :: material

      call catalogue%define(a_material, cards, "MID")
      material%id = cards%integer("MID")
      material%keyword = cards%name
      material%title = cards%word("TITLE")
      material%density = cards%real("RO")
   end subroutine begin_material

   !> A strain must cost energy: the compliance must be positive definite
   subroutine check_stability(cards, names, law, catalogue)
      !> The keyword
      type(cards_type), intent(in) :: cards
      !> Fields of the Poisson's ratios 12, 13, 23
      character(*), intent(in) :: names(3)
      !> Elastic constants
      class(law_constants_type), intent(in) :: law
      !> Gets the finding
      type(catalogue_type), intent(inout) :: catalogue

      integer, parameter :: first(3) = [1, 1, 2], second(3) = [2, 3, 3]
      real(wp) :: bound, determinant, share(3)
      integer :: i

      if (any(law%young <= 0.0_wp)) return
      do i = 1, size(names)
         bound = sqrt(law%young(first(i))/law%young(second(i)))
         share(i) = law%poisson(i)/bound
         if (abs(share(i)) < 1.0_wp) cycle
         call catalogue%refuse(cards, names(i), "Poisson's ratio nu"//text(first(i)) &
            & //text(second(i))//" = "//text(law%poisson(i)) &
            & //" is too large for these moduli", "less than sqrt(E"//text(first(i))//"/E" &
            & //text(second(i))//") = "//text(bound)//" in size, or a strain " &
            & //"would give energy")
         return
      end do
      determinant = 1.0_wp - sum(share**2) - 2.0_wp*product(share)
      if (determinant > 0.0_wp) return
      call catalogue%refuse(cards, names(3), &
         & "the three Poisson's ratios together are too large for these moduli", &
         & "a positive definite compliance: 1 - nu12 nu21 - nu13 nu31 - nu23 nu32 " &
         & //"- 2 nu12 nu23 nu31 above 0, here it is "//text(determinant))
   end subroutine check_stability

end module plydyn_input_read_material
