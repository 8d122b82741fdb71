!> Keywords of interfaces between plies.
module plydyn_input_declare_interface
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, extension, standard
   implicit none
   private

   public :: interface_cohesive, interface_law, interface_scatter, mat_cohesive_elastic, &
      & mat_cohesive_mixed_mode, mat_cohesive_general, initial_delamination, initial_damage

contains

   !> What joins two plies
   function interface_cohesive() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INTERFACE_COHESIVE", extension, &
         & "Interfaces between the plies of a laminate: cohesive zones, springs, or none.", &
         & repeated=.true.)
      keyword%remark = "Interface k lies between plies k and k + 1, counted from the bottom. " &
         & //"Interfaces that no card names are perfectly tied. CLOSE, FRIC and FIT need a " &
         & //"material that fails. CLOSE 1 is the classical law; failed faces that close again " &
         & //"can then gain energy if the time step is near the stable step, see the theory. FIT " &
         & //"1 replaces the shear stiffness by EN GIC/GIIC (S/T)**2, FIT 2 lowers both " &
         & //"strengths by one factor, so that the process zone (cohesive zone) spans three " &
         & //"distances between nodes, FIT 3 does both; the listing prints the fitted constants. " &
         & //"The constants of the material itself must be valid, too. All parts have the same " &
         & //"interfaces, materials and options."
      call keyword%add_integer("PID", "part", least=1)
      call keyword%add_integer("IFAC1", "first interface; 0 with IFAC2 = 0 for all", least=0)
      call keyword%add_integer("IFAC2", "last interface", least=0)
      call keyword%add_integer("MID", "interface material; -1 for no connection", &
         & least=-1)
      call keyword%add_integer("NQ", "quadrature: 0 Gauss points, 1 nodes", default=0, &
         & allowed=[0, 1])
      call keyword%add_integer("CLOSE", "stiffness against closing of a damaged face: 0 falls " &
         & //"with the damage, down to 10 %; 1 is constant", default=0, allowed=[0, 1])
      call keyword%add_nonnegative("FRIC", "-", "coefficient of friction of failed faces")
      call keyword%add_integer("FIT", "constants that are fitted: 0 none, 1 the shear stiffness, " &
         & //"to the energy, 2 the strengths, to the mesh, 3 both", default=0, least=0, most=3)
   end function interface_cohesive

   !> How an interface material fails where the mode changes, and under pressure
   function interface_law() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INTERFACE_LAW", extension, &
         & "Failure of an interface material under varying mode mixity and under pressure.", &
         & repeated=.true.)
      keyword%remark = "MIX 0 takes the mode mixity from the present opening. Where it changes " &
         & //"during loading, as ahead of a crack in a bent beam, the work of failure differs " &
         & //"from the fracture energy by some 10 %. MIX 1 takes it from the work of both modes " &
         & //"so far: the work of failure is then the fracture energy of its own mode mixity on " &
         & //"every path. Both are the same in pure modes and on straight paths. With ETA a " &
         & //"pressure p increases the shear strength to S + ETA p, and the fracture energy of " &
         & //"mode II grows with the square of the strength."
      call keyword%add_integer("MID", "interface material that fails", least=1)
      call keyword%add_integer("MIX", "mode mixity: 0 of the present opening, 1 of the work so " &
         & //"far", default=0, allowed=[0, 1])
      call keyword%add_nonnegative("ETA", "-", "growth of the shear strength with the pressure")
   end function interface_law

   !> Scatter of the strengths of an interface material
   function interface_scatter() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INTERFACE_SCATTER", extension, &
         & "Random scatter of the strengths of an interface material.", repeated=.true.)
      keyword%remark = "Both strengths are multiplied by a Weibull-distributed factor of mean " &
         & //"1; the fracture energy does not change. The correlation of two points at the " &
         & //"distance LENGTH is some 0.6; different interfaces are not correlated. The factor " &
         & //"depends only on the position, the interface and SEED, not on the mesh or the " &
         & //"number of ranks. The coefficient of variation is some 1.2/M."
      call keyword%add_integer("MID", "interface material that fails", least=1)
      call keyword%add_integer("SEED", "number of the realisation", least=0)
      call keyword%add_real("M", "-", "modulus of Weibull", least=2.0_wp)
      call keyword%add_real("LENGTH", "length", "length of the correlation", above=0.0_wp)
   end function interface_scatter

   !> Elastic interface material
   function mat_cohesive_elastic() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_COHESIVE_ELASTIC", standard, &
         & "Linear elastic springs between two plies.", suffixes="TITLE", alias="MAT_184")
      call add_cohesive_head(keyword)
      call keyword%add_real("ET", "stress/length", "traction per sliding", above=0.0_wp)
      call keyword%add_real("EN", "stress/length", "traction per opening", above=0.0_wp)
      call keyword%add_unused("FN_FAIL")
   end function mat_cohesive_elastic

   !> Interface material that softens
   function mat_cohesive_mixed_mode() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_COHESIVE_MIXED_MODE", standard, &
         & "Cohesive zone between two plies that softens and fails in opening (mode I), " &
         & //"sliding (mode II) and mixed mode.", &
         & suffixes="TITLE", alias="MAT_138")
      keyword%remark = "A bilinear law: damage starts at (t_n/T)**2 + (t_s/S)**2 = 1 and is " &
         & //"complete when the fracture energy of the mode mixity is dissipated. XMU above 0: " &
         & //"power law, (G_I/GIC)**XMU + (G_II/GIIC)**XMU = 1. XMU below 0: Benzeggagh-Kenane, " &
         & //"GIC + (GIIC - GIC) B**|XMU| with the share B of shear in the energy. T or S of 0 " &
         & //"follow from the ultimate displacements: T = 2 GIC/UND, S = 2 GIIC/UTD. Failed " &
         & //"faces are never deleted: they still transmit pressure when closed (INTFAIL 0). " &
         & //"Quadrature: NQ of *INTERFACE_COHESIVE."
      call add_cohesive_head(keyword)
      call keyword%add_real("EN", "stress/length", "traction per opening", above=0.0_wp)
      call keyword%add_real("ET", "stress/length", "traction per sliding", above=0.0_wp)
      call keyword%add_real("GIC", "energy/length2", "fracture energy in opening (mode I)", &
         & above=0.0_wp)
      call keyword%add_real("GIIC", "energy/length2", "fracture energy in sliding (mode II)", &
         & above=0.0_wp)
      call keyword%add_card()
      call keyword%add_real("XMU", "-", "exponent of mixed modes: 0.1 to 20 power law, -20 to " &
         & //"-0.1 Benzeggagh-Kenane")
      call keyword%add_nonnegative("T", "stress", "strength in opening; 0 for 2 GIC/UND")
      call keyword%add_nonnegative("S", "stress", "strength in sliding; 0 for 2 GIIC/UTD")
      call keyword%add_nonnegative("UND", "length", "opening at failure, where T is 0")
      call keyword%add_nonnegative("UTD", "length", "sliding at failure, where S is 0")
      call keyword%add_unused("GAMMA", neutral=[0.0_wp, 1.0_wp])
   end function mat_cohesive_mixed_mode

   !> Interface material by a curve of traction over separation
   function mat_cohesive_general() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("MAT_COHESIVE_GENERAL", standard, &
         & "Cohesive zone between two plies with a curve of traction over separation.", &
         & suffixes="TITLE", alias="MAT_186")
      keyword%remark = "Only the case that is equal to *MAT_COHESIVE_MIXED_MODE with XMU 1 is " &
         & //"supported: the dimensionless separation, TES 2, and the triangle (0, 0), (l, 1), " &
         & //"(1, 0) as TSLC. EN is then T**2/(2 GIC l), ET is S**2/(2 GIIC l). TES 0 and 1, " &
         & //"which mix the modes in another way, and other curves are errors."
      call add_cohesive_head(keyword)
      call keyword%add_integer("TES", "separation: 2 dimensionless", default=0, least=0, most=2)
      call keyword%add_integer("TSLC", "curve of traction over separation, a triangle", least=1)
      call keyword%add_real("GIC", "energy/length2", "fracture energy in opening (mode I)", &
         & above=0.0_wp)
      call keyword%add_real("GIIC", "energy/length2", "fracture energy in sliding (mode II)", &
         & above=0.0_wp)
      call keyword%add_card()
      call keyword%add_unused("XMU", neutral=[0.0_wp, 1.0_wp])
      call keyword%add_real("T", "stress", "strength in opening", above=0.0_wp)
      call keyword%add_real("S", "stress", "strength in sliding", above=0.0_wp)
      call keyword%add_unused("STFSF TSLC2")
   end function mat_cohesive_general

   !> Interfaces that are open from the start
   function initial_delamination() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INITIAL_DELAMINATION", extension, &
         & "Delaminations that exist at the start of the run.", repeated=.true.)
      keyword%remark = "The interfaces need a material that fails, which gives their faces " &
         & //"contact and friction. The area counts as failed; its fracture energy is not part " &
         & //"of the energies. A circle must contain a point of the interfaces, see NQ of " &
         & //"*INTERFACE_COHESIVE."
      call add_interface_place(keyword)
      call add_circle(keyword)
   end function initial_delamination

   !> Interfaces that are damaged from the start
   function initial_damage() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("INITIAL_DAMAGE", extension, &
         & "Damage of interfaces at the start of the run.", repeated=.true.)
      keyword%remark = "The damage is the damage variable of the law: with DAMAGE d the " &
         & //"interface has 1 - d of its stiffness, and dissipates the rest of its fracture " &
         & //"energy. Of two values for one point the larger counts."
      call add_interface_place(keyword)
      call keyword%add_real("DAMAGE", "-", "damage, above 0 and up to 1", above=0.0_wp, &
         & most=1.0_wp)
      call add_circle(keyword)
   end function initial_damage

   !> Part, interfaces and elements
   subroutine add_interface_place(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("PID", "part", least=1)
      call keyword%add_integer("IFAC1", "first interface; 0 with IFAC2 = 0 for all", least=0)
      call keyword%add_integer("IFAC2", "last interface", least=0)
      call keyword%add_integer("SSID", "set of elements; 0 for all of the part", default=0, least=0)
   end subroutine add_interface_place

   !> Circle that bounds what is broken
   subroutine add_circle(keyword)
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_real("X", "length", "x of the centre of a circle", default=0.0_wp)
      call keyword%add_real("Y", "length", "y of the centre of a circle", default=0.0_wp)
      call keyword%add_nonnegative("R", "length", "only points within this distance of the " &
         & //"centre; 0 for whole elements")
   end subroutine add_circle

   !> Number and density of an interface material
   subroutine add_cohesive_head(keyword)
      !> The keyword of the material
      type(keyword_type), intent(inout) :: keyword

      call keyword%add_integer("MID", "number of the material", least=1)
      call keyword%add_nonnegative("RO", "mass/length2", "without effect: an interface has no mass")
      call keyword%add_unused("ROFLG", neutral=[0.0_wp, 1.0_wp])
      call keyword%add_unused("INTFAIL")
   end subroutine add_cohesive_head

end module plydyn_input_declare_interface
