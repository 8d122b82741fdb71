!> Keywords of the contact of impactors and of output.
module plydyn_input_declare_impact
   use plydyn_base_precision, only : wp
   use plydyn_deck_declaration, only : keyword_type, new_keyword, extension, standard
   use plydyn_input_rigid_body, only : add_friction
   implicit none
   private

   public :: contact_impactor, database, database_spcforc, database_history_node, &
      & database_history_node_set, database_field, database_profile

   !> Nodes on a card
   integer, parameter :: list_fields = 8
   !> Names of the fields that can be written
   character(*), parameter :: field_names = &
      & "DISPLACEMENT VELOCITY STRESS STRAIN STRESS_PLY STRAIN_PLY PLASTIC_STRAIN " &
      & //"DAMAGE_FIBRE DAMAGE_MATRIX DAMAGE_SHEAR DISSIPATED"

contains

   !> Contact of an impactor and the plate
   function contact_impactor() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("CONTACT_IMPACTOR", extension, &
         & "Contact between an impactor and a face of the plate.", suffixes="TITLE")
      call keyword%add_integer("CID", "number of the contact", least=1)
      call keyword%add_integer("IID", "impactor", least=1)
      call keyword%add_integer("PID", "part; 0 for all parts", default=0, least=0)
      call keyword%add_integer("FACE", "-1 bottom face, 1 top face", allowed=[-1, 1])
      call keyword%add_integer("METHOD", "1 nodes on the impactor against the facets of the " &
         & //"plate, 2 points of the plate against the exact body", default=1, allowed=[1, 2])
      call keyword%add_nonnegative("SPACING", "length", "distance between nodes on the " &
         & //"impactor; 0 for one made from the mesh")
      call keyword%add_card(optional=.true.)
      call add_friction(keyword)
   end function contact_impactor

   !> A keyword that asks for one output
   function database(name, own, what, unused) result(keyword)
      !> Name of the keyword
      character(*), intent(in) :: name
      !> `extension` or `standard`
      logical, intent(in) :: own
      !> What is written, and fields of LS-DYNA without effect here
      character(*), intent(in) :: what, unused
      type(keyword_type) :: keyword

      keyword = new_keyword(name, own, "Time between two "//what//".")
      keyword%once = .true.
      if (name == "DATABASE_BINARY_D3PLOT") then
         call keyword%add_real("DT", "time", "time between two "//what, above=0.0_wp)
      else
         call keyword%add_real("DT", "time", "time between two "//what//"; 0 for every step", &
            & least=0.0_wp)
      end if
      if (index(unused, "BINARY") == 1) then
         call keyword%add_unused("BINARY", neutral=[0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp])
         call keyword%add_unused("LCUR")
         call keyword%add_unused("IOOPT", neutral=[0.0_wp, 1.0_wp])
         call keyword%add_unused("OPTION1 OPTION2 OPTION3 OPTION4")
      else
         call keyword%add_unused(unused)
      end if
      if (index(unused, "LCDT") /= 1) return
      call keyword%add_card(optional=.true.)
      call keyword%add_unused("IOOPT RATE CUTOFF WINDOW TYPE PSET")
   end function database

   !> Forces of supports
   function database_spcforc() result(keyword)
      type(keyword_type) :: keyword

      keyword = database("DATABASE_SPCFORC", standard, "support forces", "BINARY LCUR IOOPT")
      keyword%remark = "`JOB.supports.csv` has the force of all supports and prescribed " &
         & //"motions together, and that of each by its keyword and node set, as in `spc 3 fx` " &
         & //"or `motion 2 fx`: also what LS-DYNA writes to BNDOUT. Where several supports hold " &
         & //"a point in one direction, the first in the deck has its force."
   end function database_spcforc

   !> Nodes with a history
   function database_history_node() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_HISTORY_NODE", standard, "Nodes whose history is written.")
      call keyword%add_card(repeated=.true.)
      call keyword%add_list("ID", list_fields, "node")
   end function database_history_node

   !> Sets of nodes with a history
   function database_history_node_set() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_HISTORY_NODE_SET", standard, &
         & "Sets of nodes whose history is written.")
      call keyword%add_card(repeated=.true.)
      call keyword%add_list("ID", list_fields, "node set")
   end function database_history_node_set

   !> Fields of the field states
   function database_field() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_FIELD", extension, "Which fields the field states hold.")
      keyword%remark = "Names with blanks or commas between them, any number of lines. Without " &
         & //"the keyword: displacement, velocity and stress, and where a ply is damaged " &
         & //"DAMAGE_FIBRE, DAMAGE_MATRIX and DAMAGE_SHEAR, all from 0 to 1. PLASTIC_STRAIN, the " &
         & //"effective plastic strain, needs a material that yields; DISSIPATED is energy per " &
         & //"volume."
      call keyword%add_card(repeated=.true.)
      call keyword%add_words("NAME", "name of a field", field_names)
   end function database_field

   !> Stress through the thickness
   function database_profile() result(keyword)
      type(keyword_type) :: keyword

      keyword = new_keyword("DATABASE_PROFILE", extension, &
         & "Displacement, strain and stress through the thickness at a place of the plate.", &
         & repeated=.true.)
      call keyword%add_integer("ID", "number of the profile", least=1)
      call keyword%add_real("X", "length", "x of the place")
      call keyword%add_real("Y", "length", "y of the place")
      call keyword%add_integer("NPT", "points in each numerical layer, its faces included", &
         & default=5, least=2, most=100)
      call keyword%add_nonnegative("DT", "time", "time between two profiles; blank for a " &
         & //"hundred in the run, 0 for every step")
   end function database_profile

end module plydyn_input_declare_impact
