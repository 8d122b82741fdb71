!> Keywords of supports, motions, loads and initial velocities.
module plydyn_input_declare_load
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : extension, keyword_type, new_keyword, standard
   implicit none
   private

   public :: boundary_face, boundary_face_motion, boundary_prescribed_motion_set, &
      & boundary_spc_set, constrained_face_linear, constrained_linear_global, initial_velocity, &
      & initial_velocity_node, load_body, load_face_line, load_face_point, load_face_pressure, &
      & load_node, load_shell_set

contains

   !> Supports of all planes
   function boundary_spc_set() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("BOUNDARY_SPC_SET", standard, &
         & "Fixes nodes over the whole thickness; clamped with all three directions.", &
         & repeated=.true., suffixes="ID")
      keyword%remark = "A direction is fixed at all points through the thickness. The points " &
         & //"have no rotations: DOFRX to DOFRZ may be 1 where DOFX, DOFY and DOFZ are all 1 " &
         & //"(clamped), since the points cannot rotate there."
      call keyword%add_integer("NSID", "node set", least=1)
      call keyword%add_unused("CID")
      call add_directions(keyword)
      call keyword%add_integer("DOFRX", "1 only for clamped nodes", default=0, allowed=[0, 1])
      call keyword%add_integer("DOFRY", "1 only for clamped nodes", default=0, allowed=[0, 1])
      call keyword%add_integer("DOFRZ", "1 only for clamped nodes", default=0, allowed=[0, 1])
   end function boundary_spc_set

   !> Supports of one face or plane
   function boundary_face() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("BOUNDARY_FACE", extension, "Fixes one face, or one plane of " &
         & //"points, of some nodes.", &
         & repeated=.true.)
      call keyword%add_integer("NSID", "node set", least=1)
      call keyword%add_integer("FACE", "-1 bottom face, 1 top face, 0 the plane at height Z", &
         & allowed=[-1, 0, 1])
      call keyword%add_real("Z", "length", "height above the nodes, for FACE 0", default=0.0_wp)
      call add_directions(keyword)
   end function boundary_face

   !> Directions that a support holds
   subroutine add_directions(keyword)
      !> The keyword of the support
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("DOFX", "1 holds x", default=0, allowed=[0, 1])
      call keyword%add_integer("DOFY", "1 holds y", default=0, allowed=[0, 1])
      call keyword%add_integer("DOFZ", "1 holds z", default=0, allowed=[0, 1])
   end subroutine add_directions

   !> Motion of all planes
   function boundary_prescribed_motion_set() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("BOUNDARY_PRESCRIBED_MOTION_SET", standard, &
         & "Moves nodes over the whole thickness.", repeated=.true., suffixes="ID")
      call keyword%add_integer("NSID", "node set", least=1)
      call add_motion(keyword)
      call keyword%add_integer("LCID", "curve", least=1)
      call add_factor(keyword)
      call keyword%add_unused("VID")
      call keyword%add_nonnegative("DEATH", "time", "it acts until then; 0 for ever")
      call keyword%add_nonnegative("BIRTH", "time", "it acts from then on")
   end function boundary_prescribed_motion_set

   !> Motion of one face
   function boundary_face_motion() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("BOUNDARY_FACE_MOTION", extension, "Moves one face of some nodes.", &
         & repeated=.true.)
      call keyword%add_integer("NSID", "node set", least=1)
      call add_face(keyword)
      call add_motion(keyword)
      call add_curve(keyword)
   end function boundary_face_motion

   !> Direction and quantity of a motion
   subroutine add_motion(keyword)
      !> The keyword of the motion
      type(keyword_type), intent(inout) :: keyword

      call add_direction(keyword)
      call keyword%add_integer("VAD", "0 velocity, 1 acceleration, 2 displacement", &
         & allowed=[0, 1, 2])
   end subroutine add_motion

   !> Initial velocity of a set
   function initial_velocity() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INITIAL_VELOCITY", standard, &
         & "Velocity of nodes at time zero, over the whole thickness.")
      keyword%remark = "A later keyword overrides an earlier one. Impactors have a velocity of " &
         & //"their own."
      call keyword%add_integer("NSID", "node set; 0 for all nodes", default=0, least=0)
      call keyword%add_unused("NSIDEX BOXID IRIGID ICID")
      call keyword%add_card()
      call add_velocity(keyword)
      call keyword%add_unused("VXR VYR VZR")
   end function initial_velocity

   !> Initial velocity of nodes
   function initial_velocity_node() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INITIAL_VELOCITY_NODE", standard, &
         & "Velocity of single nodes at time zero, over the whole thickness.", repeated=.true.)
      call keyword%add_integer("NID", "node", least=1)
      call add_velocity(keyword)
      call keyword%add_unused("VXR VYR VZR ICID")
   end function initial_velocity_node

   !> Components of a velocity
   subroutine add_velocity(keyword)
      !> The keyword of the velocity
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_real("VX", "length/time", "velocity along x", default=0.0_wp)
      call keyword%add_real("VY", "length/time", "velocity along y", default=0.0_wp)
      call keyword%add_real("VZ", "length/time", "velocity along z", default=0.0_wp)
   end subroutine add_velocity

   !> Forces at nodes, shared over the thickness
   function load_node(name, target, sentence) result(keyword)
      !> Name of the keyword, and name of its first field
      character(*), intent(in) :: name, target
      !> What that field holds
      character(*), intent(in) :: sentence
      type(keyword_type) :: keyword

      keyword = new_keyword(name, standard, &
         & "A force at each node, shared by the thickness in proportion to mass.", repeated=.true.)
      call keyword%add_integer(target, sentence, least=1)
      call add_direction(keyword)
      call keyword%add_integer("LCID", "curve", least=1)
      call add_factor(keyword)
      call keyword%add_unused("CID M1 M2 M3")
   end function load_node

   !> Forces at nodes of a face
   function load_face_point() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("LOAD_FACE_POINT", extension, "A force at a node of a face.", &
         & repeated=.true.)
      call keyword%add_integer("NID", "node", least=1)
      call add_face(keyword)
      call add_direction(keyword)
      call add_curve(keyword)
   end function load_face_point

   !> Forces along a line of a face
   function load_face_line() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("LOAD_FACE_LINE", extension, &
         & "A force per length along the element edges between the nodes of a set.", &
         & repeated=.true.)
      keyword%remark = "Every element edge with all its nodes in the set carries the load."
      call keyword%add_integer("NSID", "node set", least=1)
      call keyword%add_integer("FACE", "-1 bottom face, 1 top face", allowed=[-1, 1])
      call add_direction(keyword)
      call add_curve(keyword)
   end function load_face_line

   !> Pressure of LS-DYNA
   function load_shell_set() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("LOAD_SHELL_SET", standard, &
         & "A pressure against the normal of some elements: onto the top face, downwards.", &
         & repeated=.true., suffixes="ID")
      call keyword%add_integer("ESID", "shell set", least=1)
      call keyword%add_integer("LCID", "curve", least=1)
      call add_factor(keyword)
      call keyword%add_unused("AT")
   end function load_shell_set

   !> Pressure onto a face
   function load_face_pressure() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("LOAD_FACE_PRESSURE", extension, &
         & "A pressure onto a face: down onto the top one, up onto the bottom one.", &
         & repeated=.true.)
      call keyword%add_integer("SSID", "shell set; 0 for all elements", least=0)
      call keyword%add_integer("FACE", "-1 bottom face, 1 top face", allowed=[-1, 1])
      call add_curve(keyword)
   end function load_face_pressure

   !> Acceleration of the frame
   function load_body(name, axis) result(keyword)
      !> Name of the keyword, and name of the axis
      character(*), intent(in) :: name, axis
      type(keyword_type) :: keyword

      keyword = new_keyword(name, standard, "An acceleration of the frame along "//axis &
         & //": the body force is against it.")
      keyword%once = .true.
      call keyword%add_integer("LCID", "curve", least=1)
      call add_factor(keyword)
      call keyword%add_unused("LCIDDR XC YC ZC CID")
   end function load_body

   !> Face that something acts on, or all planes
   subroutine add_face(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("FACE", "-1 bottom face, 1 top face, 2 all planes", &
         & allowed=[-1, 1, 2])
   end subroutine add_face

   !> Direction of a load or motion
   subroutine add_direction(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("DOF", "1, 2, 3 for x, y, z", allowed=[1, 2, 3])
   end subroutine add_direction

   !> Curve and factor of our own keywords
   subroutine add_curve(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("LCID", "curve; 0 for the constant 1", least=0)
      call add_factor(keyword)
   end subroutine add_curve

   !> Factor on a curve
   subroutine add_factor(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_real("SF", "any", "factor on the curve", default=1.0_wp)
   end subroutine add_factor

   !> Constraint of LS-DYNA
   function constrained_linear_global() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONSTRAINED_LINEAR_GLOBAL", standard, &
         & "The sum of COEF times displacement over all rows is zero.")
      keyword%remark = "Above a node of a plate it is the mean displacement over the thickness, " &
         & //"by mass, that counts; *CONSTRAINED_FACE_LINEAR takes the points of a face. " &
         & //in_common()
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

end module plydyn_input_declare_load
