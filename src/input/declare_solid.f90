!> Keywords of bricks.
module plydyn_input_declare_solid
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, standard
   implicit none
   private

   public :: element_solid, element_solid_ortho, part, section_solid, hourglass, &
      & control_hourglass, load_segment

   !> Columns of the fields of an element, and of a vector
   integer, parameter :: element_width = 8, vector_width = 16

contains

   !> Bricks
   function element_solid() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("ELEMENT_SOLID", standard, "Bricks of eight nodes.", repeated=.true.)
      keyword%remark = "Four nodes of a face, counter-clockwise seen from the opposite face, " &
         & //"then the four of that face in the same order. A deck has plates or bricks, not " &
         & //"both. Bricks take no keyword that needs plies, faces or quads, and no " &
         & //"*DATABASE_PROFILE. Every part of bricks has one material, whose axis angle is that " &
         & //"of the fibres: *MAT_ORTHOTROPIC_ELASTIC with AOPT 2 for each direction; or the " &
         & //"bricks have their own in *ELEMENT_SOLID_ORTHO."
      call add_brick(keyword)
   end function element_solid

   !> Bricks with axes of their own
   function element_solid_ortho() result(keyword)
      type(keyword_type) :: keyword
      integer :: i

      keyword = new_keyword("ELEMENT_SOLID_ORTHO", standard, "Bricks of eight nodes with fibres " &
         & //"in directions of their own.", repeated=.true.)
      keyword%remark = "As *ELEMENT_SOLID, with the axes of the ply in each brick: they take the " &
         & //"place of those of its material. Plies lie in planes of constant z."
      call add_brick(keyword)
      call keyword%add_card()
      keyword%width = vector_width
      do i = 1, 3
         call keyword%add_real("A"//achar(iachar("0") + i), "-", "vector along the fibres, " &
            & //"component "//achar(iachar("0") + i), default=0.0_wp)
      end do
      call keyword%add_card()
      do i = 1, 3
         call keyword%add_real("D"//achar(iachar("0") + i), "-", "vector in the plane of the " &
            & //"ply, to the left of A, component "//achar(iachar("0") + i), default=0.0_wp)
      end do
   end function element_solid_ortho

   !> The card of a brick
   subroutine add_brick(keyword)
      type(keyword_type), intent(inout) :: keyword

      integer :: i

      keyword%width = element_width
      call keyword%add_card()
      call keyword%add_integer("EID", "number of the brick", least=1)
      call keyword%add_integer("PID", "part", least=1)
      do i = 1, 8
         call keyword%add_integer("N"//achar(iachar("0") + i), "node", least=1)
      end do
   end subroutine add_brick

   !> A part of bricks
   function part() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("PART", standard, "Bricks of one material.")
      keyword%remark = "Laminates have their plies in *PART_COMPOSITE."
      call keyword%add_text_card("TITLE", "title of the part")
      call keyword%add_card()
      call keyword%add_integer("PID", "number of the part", least=1)
      call keyword%add_integer("SECID", "*SECTION_SOLID", least=1)
      call keyword%add_integer("MID", "material", least=1)
      call keyword%add_unused("EOSID")
      call keyword%add_integer("HGID", "*HOURGLASS; 0 for *CONTROL_HOURGLASS", default=0, least=0)
      call keyword%add_unused("GRAV ADPOPT TMID")
   end function part

   !> Integration of bricks
   function section_solid() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("SECTION_SOLID", standard, "How bricks are integrated.", &
         & suffixes="TITLE")
      keyword%remark = "ELFORM 1: one point, with the mean gradients of the brick, which need " &
         & //"hourglass control. ELFORM 2: eight points that share the mean of their volume " &
         & //"strain, but in plies that are damaged. 19 and 20, cohesive bricks, are refused: " &
         & //"*INTERFACE_COHESIVE joins plies of one part."
      call keyword%add_integer("SECID", "number of the section", least=1)
      call keyword%add_integer("ELFORM", "1 one point, 2 eight points", default=1, &
         & allowed=[1, 2, 19, 20])
      call keyword%add_unused("AET")
   end function section_solid

   !> Hourglass control of some parts
   function hourglass() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("HOURGLASS", standard, "Hourglass control of parts that name it.", &
         & suffixes="TITLE")
      call keyword%add_integer("HGID", "number of the control", least=1)
      call add_control(keyword, "QM")
      call keyword%add_unused("IBQ Q1 Q2 QB QW")
   end function hourglass

   !> Hourglass control of all other parts
   function control_hourglass() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTROL_HOURGLASS", standard, "Hourglass control of parts that name " &
         & //"none.")
      keyword%remark = "Without the keyword: IHQ 6 and QH 0.1."
      keyword%once = .true.
      call add_control(keyword, "QH")
   end function control_hourglass

   !> Kind and coefficient of hourglass control
   subroutine add_control(keyword, coefficient)
      type(keyword_type), intent(inout) :: keyword
      !> Name of the coefficient
      character(*), intent(in) :: coefficient

      call keyword%add_integer("IHQ", "3 viscous, after Flanagan and Belytschko; 6 stiffness, by " &
         & //"assumed strain after Belytschko and Bindeman", allowed=[3, 6])
      call keyword%add_real(coefficient, "-", "coefficient; with IHQ 6 and 1 elastic bricks bend " &
         & //"as they should", default=0.1_wp, least=0.0_wp, most=1.0_wp)
      call keyword%zero_is_default()
   end subroutine add_control

   !> Pressure on faces of bricks
   function load_segment() result(keyword)
      type(keyword_type) :: keyword
      integer :: i

      keyword = new_keyword("LOAD_SEGMENT", standard, "Pressure on faces between four nodes.", &
         & repeated=.true.)
      keyword%remark = "The pressure acts against the normal that the nodes turn around " &
         & //"counter-clockwise, in the undeformed shape."
      call keyword%add_integer("LCID", "curve", least=1)
      call keyword%add_real("SF", "stress", "factor on the curve", default=1.0_wp)
      call keyword%zero_is_default()
      call keyword%add_unused("AT")
      do i = 1, 4
         call keyword%add_integer("N"//achar(iachar("0") + i), "node", least=1)
      end do
   end function load_segment

end module plydyn_input_declare_solid
