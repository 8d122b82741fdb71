!> Keywords of elastic materials, and what all materials of plies share.
module plydyn_input_material
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_deck_declaration, only : extension, standard
   use plydyn_input_card_visitor, only : card_visitor_type
   use plydyn_input_catalogue, only : a_material
   use plydyn_input_keyword_row, only : keyword_list_type, stage_material
   use plydyn_law_law, only : law_constants_type
   use plydyn_law_ply_elastic, only : elastic_constants_type
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: add_elastic_materials, check_stability, set_axes, visit_axes_option, visit_head, &
      & visit_isotropic, visit_plane_vector, visit_ply

   !> Poisson's ratio of an isotropic material lies between these
   real(wp), parameter :: least_poisson = -1.0_wp, most_poisson = 0.5_wp
   real(wp), parameter :: degrees = 180.0_wp/acos(-1.0_wp)
   !> Names of the axes of a ply
   integer, parameter :: first(3) = [1, 1, 2], second(3) = [2, 3, 3]

contains

   !> Add these keywords
   subroutine add_elastic_materials(list)
      type(keyword_list_type), intent(inout) :: list

      call list%add("MAT_ELASTIC", mat_elastic, stage_material)
      call list%add("MAT_ORTHOTROPIC_ELASTIC", mat_orthotropic_elastic, stage_material)
      call list%add("MAT_PLY_ELASTIC", mat_ply_elastic, stage_material)
   end subroutine add_elastic_materials

   !> Isotropic material
   subroutine mat_elastic(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(elastic_constants_type) :: law
      type(material_type) :: material

      call card%keyword(standard, "Isotropic linear elastic ply material.", alias="MAT_001")
      call card%example("elastic-plies", "1, 7.8e-9, 210.0e3, 0.3")
      call visit_isotropic(card, material, law)
      call card%unused("DA DB K")
      if (card%reads) call add_material(model%materials, material, law)
   end subroutine mat_elastic

   !> Ply material by its engineering constants
   subroutine mat_ply_elastic(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      type(elastic_constants_type) :: law
      type(material_type) :: material

      call card%keyword(extension, "Orthotropic linear elastic ply: 1 along the fibres, 2 across " &
         & //"in the plane, 3 normal.")
      call card%example("elastic-plies", "1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.3, 0.3, 0.4|" &
         & //"6.0e3, 6.0e3, 3.7e3")
      call visit_ply(card, material, law)
      if (card%reads) call add_material(model%materials, material, law)
   end subroutine mat_ply_elastic

   !> Orthotropic material of LS-DYNA
   subroutine mat_orthotropic_elastic(card, model)
      class(card_visitor_type), intent(inout) :: card
      type(model_type), intent(inout) :: model

      character(1), parameter :: axes(3) = ["A", "B", "C"], names(3) = ["a", "b", "c"]
      type(elastic_constants_type) :: law
      type(material_type) :: material
      real(wp) :: a(2), d(2), minor(3)
      integer :: i

      call card%keyword(standard, "Orthotropic linear elastic ply material with axes a, b, c.", &
         & alias="MAT_002")
      call card%remark("The Poisson's ratios are the minor ones: PRBA EA = nu_ab EB and so on. " &
         & //"a and d lie in the plane of the plate, d counter-clockwise from a.")
      call card%example("elastic-plies", "1, 1.6e-9, 153.0e3, 10.3e3, 10.3e3, 0.02, 0.02, 0.4|" &
         & //"6.0e3, 3.7e3, 6.0e3, 2|0, 0, 0, 1.0, 0, 0|0, 0, 0, 0, 1.0, 0")
      call visit_head(card, material)
      do i = 1, 3
         call card%positive("E"//axes(i), "stress", "Young's modulus along "//names(i), &
            & law%young(i))
      end do
      do i = 1, 3
         call card%real("PR"//axes(second(i))//axes(first(i)), "-", "strain along " &
            & //names(first(i))//" from stress along "//names(second(i)), minor(i))
      end do
      call card%card()
      call card%positive("GAB", "stress", "shear modulus in the plane a-b", law%shear(1))
      call card%positive("GBC", "stress", "shear modulus in the plane b-c", law%shear(3))
      call card%positive("GCA", "stress", "shear modulus in the plane c-a", law%shear(2))
      call visit_axes_option(card)
      call card%unused("G SIGF")
      call visit_plane_vector(card, "XP YP ZP", "A", "a", a)
      call card%unused("MACF", neutral=[0.0_wp, 1.0_wp])
      call card%unused("IHIS")
      call visit_plane_vector(card, "V1 V2 V3", "D", "d", d)
      call card%unused("BETA REF")
      if (.not. card%reads) return
      if (all(law%young > 0.0_wp)) then
         law%poisson(:) = minor*law%young(first)/law%young(second)
         call check_stability(card, ["PRBA", "PRCA", "PRCB"], law)
      end if
      call set_axes(card, a, d, material)
      call add_material(model%materials, material, law)
   end subroutine mat_orthotropic_elastic

   !> Number, title and density of a ply material
   subroutine visit_head(card, material)
      class(card_visitor_type), intent(inout) :: card
      type(material_type), intent(inout) :: material

      call card%title(material%title)
      call card%define(a_material, "MID", "number of the material", material%id)
      call card%positive("RO", "mass/length3", "density", material%density)
      material%keyword = card%name
   end subroutine visit_head

   !> The material and its elastic constants, on a card that may have more
   subroutine visit_isotropic(card, material, law)
      class(card_visitor_type), intent(inout) :: card
      type(material_type), intent(inout) :: material
      !> Gets the elastic constants
      class(law_constants_type), intent(inout) :: law

      real(wp) :: poisson

      call visit_head(card, material)
      call card%positive("E", "stress", "Young's modulus", law%young(1))
      call card%real("PR", "-", "Poisson's ratio, above -1 and below 0.5", poisson, default=0.0_wp)
      if (.not. card%reads) return
      law%young(:) = law%young(1)
      law%poisson(:) = poisson
      if (poisson > least_poisson .and. poisson < most_poisson) then
         law%shear(:) = law%young(1)/(2.0_wp*(1.0_wp + poisson))
      else
         call card%refuse("PR", "PR cannot be "//text(poisson), &
            & "a number above -1 and below 0.5, or a strain would give energy")
      end if
   end subroutine visit_isotropic

   !> The material and its engineering constants in its own axes
   subroutine visit_ply(card, material, law)
      class(card_visitor_type), intent(inout) :: card
      type(material_type), intent(inout) :: material
      !> Gets the elastic constants
      class(law_constants_type), intent(inout) :: law

      integer :: i

      call card%card()
      call visit_head(card, material)
      do i = 1, 3
         call card%positive("E"//text(i), "stress", "Young's modulus along "//text(i), law%young(i))
      end do
      do i = 1, 3
         call card%real("NU"//text(first(i))//text(second(i)), "-", "Poisson's ratio: strain " &
            & //"along "//text(second(i))//" from stress along "//text(first(i)), law%poisson(i))
      end do
      call card%card()
      do i = 1, 3
         call card%positive("G"//text(first(i))//text(second(i)), "stress", "shear modulus in " &
            & //"the plane "//text(first(i))//"-"//text(second(i)), law%shear(i))
      end do
      if (card%reads) call check_stability(card, ["NU12", "NU13", "NU23"], law)
   end subroutine visit_ply

   !> How the axes of a material are given
   subroutine visit_axes_option(card)
      class(card_visitor_type), intent(inout) :: card

      real(wp) :: option

      call card%real("AOPT", "-", "2: a and d are given", option, least=2.0_wp, most=2.0_wp)
   end subroutine visit_axes_option

   !> A card with a vector in the plane of the plate
   subroutine visit_plane_vector(card, before, letter, name, vector)
      class(card_visitor_type), intent(inout) :: card
      !> Unused fields before it
      character(*), intent(in) :: before
      !> Letter of its fields, and its name
      character(1), intent(in) :: letter, name
      !> Its components in the plane
      real(wp), intent(inout) :: vector(2)

      real(wp) :: normal

      call card%card()
      call card%unused(before)
      call card%real(letter//"1", "-", "x of "//name, vector(1))
      call card%real(letter//"2", "-", "y of "//name, vector(2))
      call card%real(letter//"3", "-", "z of "//name//", zero", normal, default=0.0_wp, &
         & least=0.0_wp, most=0.0_wp)
   end subroutine visit_plane_vector

   !> Direction of the axis a of a material whose vectors a and d lie in the plane of the plate
   subroutine set_axes(card, a, d, material)
      class(card_visitor_type), intent(inout) :: card
      !> The vectors
      real(wp), intent(in) :: a(2), d(2)
      !> Gets its axis angle
      type(material_type), intent(inout) :: material

      if (.not. (card%is_fine("A1") .and. card%is_fine("A2") .and. card%is_fine("D1") &
         & .and. card%is_fine("D2"))) return
      if (a(1)*d(2) - a(2)*d(1) > 0.0_wp) then
         material%axis_angle = degrees*atan2(a(2), a(1))
      else if (norm2(a) <= 0.0_wp) then
         call card%refuse("A1", "a is zero", "a vector in the plane of the plate")
      else
         call card%refuse("D1", "d is not counter-clockwise from a", &
            & "a and d in the plane of the plate, d between 0 and 180 degrees from a")
      end if
   end subroutine set_axes

   !> A strain must cost energy: the compliance must be positive definite
   subroutine check_stability(card, names, law)
      class(card_visitor_type), intent(inout) :: card
      !> Fields of the Poisson's ratios 12, 13, 23
      character(*), intent(in) :: names(3)
      !> Elastic constants
      class(law_constants_type), intent(in) :: law

      real(wp) :: bound, determinant, share(3)
      integer :: i

      if (any(law%young <= 0.0_wp)) return
      do i = 1, size(names)
         bound = sqrt(law%young(first(i))/law%young(second(i)))
         share(i) = law%poisson(i)/bound
         if (abs(share(i)) < 1.0_wp) cycle
         call card%refuse(names(i), "Poisson's ratio nu"//text(first(i))//text(second(i))//" = " &
            & //text(law%poisson(i))//" is too large for these moduli", "less than sqrt(E" &
            & //text(first(i))//"/E"//text(second(i))//") = "//text(bound)//" in size, or a " &
            & //"strain would give energy")
         return
      end do
      determinant = 1.0_wp - sum(share**2) - 2.0_wp*product(share)
      if (determinant > 0.0_wp) return
      call card%refuse(names(3), &
         & "the three Poisson's ratios together are too large for these moduli", &
         & "a positive definite compliance: 1 - nu12 nu21 - nu13 nu31 - nu23 nu32 " &
         & //"- 2 nu12 nu23 nu31 above 0, here it is "//text(determinant))
   end subroutine check_stability

end module plydyn_input_material
