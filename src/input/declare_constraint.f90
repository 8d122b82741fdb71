!> Keywords of linear constraints between displacements.
module plydyn_input_declare_constraint
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword, standard
   implicit none
   private

   public :: constrained_face_linear, constrained_linear_global

contains

   !> Constraint of LS-DYNA
   function constrained_linear_global() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONSTRAINED_LINEAR_GLOBAL", standard, &
         & "The sum of COEF times displacement over all rows is zero.")
      keyword%remark = "Above a node of a plate it is the mean displacement over the thickness, " &
         & //"by mass, that counts; *CONSTRAINED_FACE_LINEAR takes the points of a face. " &
         & //in_common()
      call keyword%add_card()
      call keyword%add_integer("LCID", "number of the constraint", least=1)
      call keyword%add_card(repeated=.true.)
      call keyword%add_integer("NID", "node", least=1)
      call add_term(keyword)
   end function constrained_linear_global

   !> Constraint between points of faces, which may be led
   function constrained_face_linear() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONSTRAINED_FACE_LINEAR", extension, &
         & "The sum of COEF times displacement over all rows is zero, or follows a curve.")
      keyword%remark = "A lever without mass is such a sum: its end is at (1 + c/L) of the " &
         & //"displacement under it less c/L of that at its hinge, and the load that moves the " &
         & //"end is the force of the constraint. "//in_common()
      call keyword%add_card()
      call keyword%add_integer("ID", "number of the constraint", least=1)
      call keyword%add_integer("VAD", "what LCID leads: 0 rate of the sum, 2 the sum", default=2, &
         & allowed=[0, 2])
      call keyword%add_integer("LCID", "curve; 0 for a sum of zero", default=0, least=0)
      call keyword%add_real("SF", "any", "factor on the curve", default=1.0_wp)
      call keyword%add_card(repeated=.true.)
      call keyword%add_integer("NID", "node", least=1)
      call keyword%add_integer("FACE", "-1 bottom face, 1 top face, 2 mean over the thickness", &
         & allowed=[-1, 1, 2])
      call add_term(keyword)
   end function constrained_face_linear

   !> What both say
   pure function in_common() result(words)
      character(:), allocatable :: words

      words = "A point is in one constraint at most, is not held or moved in the same direction, " &
         & //"and not on a face that an impactor or a fixture meets. With *DATABASE_SPCFORC " &
         & //"`JOB.constraints.csv` has sum and force of each. IMPL must be 0, and a restart " &
         & //"keeps the constraints."
   end function in_common

   !> Direction and coefficient of a row
   subroutine add_term(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("DOF", "1, 2, 3 for x, y, z", allowed=[1, 2, 3])
      call keyword%add_real("COEF", "-", "coefficient, not 0")
   end subroutine add_term

end module plydyn_input_declare_constraint
