!> The history of single nodes on both faces of the plate, JOB.nodes.csv.
module plydyn_io_csv_node_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_supports, only : face_point
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : bottom_face, top_face
   use plydyn_io_owned_columns, only : counted_columns
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> Most characters of a header, and of a unit
   integer, parameter :: header_length = 40

   !> The history of some nodes
   type, public, extends(history_recorder_type) :: node_history_type
      private
      !> Places in the arrays of motion, 0 where another rank counts the node
      integer, allocatable :: freedom(:)
      !> The line, and which of its values this rank has
      real(wp), allocatable :: row(:)
      logical, allocatable :: is_known(:)
   contains
      procedure :: open => open_nodes
      procedure :: record => record_nodes
   end type node_history_type

contains

   !> Find the nodes, and create the file, if the deck asks for any
   subroutine open_nodes(self, job, simulation, error)
      class(node_history_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      character(header_length), allocatable :: names(:), units(:)
      integer :: columns, face, faces, i

      associate (domain => simulation%domain, model => simulation%model)
         if (size(model%request%nodes) == 0) return
         allocate (self%freedom(0))
         ! the node of an element in space is one point
         faces = merge(2, 1, any(domain%layers%order > 0))
         do i = 1, size(model%request%nodes)
            do face = 1, faces
               self%freedom = [self%freedom, places_of(domain, &
                  & model%mesh%node_id(model%request%nodes(i)), &
                  & face_point(domain%layers, merge(bottom_face, top_face, face == 1)))]
            end do
         end do
         columns = 1 + 2*size(self%freedom)
         allocate (self%row(columns), self%is_known(columns), names(columns), units(columns))
         self%is_known(:) = [.false., [([spread(self%freedom(i) > 0, 1, 6)], &
            & i=1, size(self%freedom), 3)]]
         call name_columns(model, faces, names, units)
         call self%open_file(job, simulation, ".nodes.csv", names, units, &
            & model%request%node_interval, error)
      end associate
   end subroutine open_nodes

   !> Time, then for each node and face displacement and velocity, such as `n17 top uz`
   pure subroutine name_columns(model, faces, names, units)
      type(model_type), intent(in) :: model
      !> 2 where a node has a point on both faces of the plate, 1 where it is a point
      integer, intent(in) :: faces
      character(header_length), intent(out) :: names(:), units(:)

      character(2), parameter :: motion(6) = ["ux", "uy", "uz", "vx", "vy", "vz"]
      character(7), parameter :: face_name(2) = [" bottom", " top   "]
      character(:), allocatable :: of_point
      integer :: c, face, i, k

      names(1) = "time"
      units(1) = model%control%units%time
      k = 1
      do i = 1, size(model%request%nodes)
         do face = 1, faces
            of_point = "n"//text(model%mesh%node_id(model%request%nodes(i)))
            if (faces > 1) of_point = of_point//trim(face_name(face))
            do c = 1, size(motion)
               k = k + 1
               names(k) = of_point//" "//motion(c)
               units(k) = model%control%units%length
               if (c > 3) units(k) = trim(units(k))//"/"//model%control%units%time
            end do
         end do
      end do
   end subroutine name_columns

   !> Places of a point above a node in the arrays of motion; 0 where this rank does not count it
   function places_of(domain, id, point) result(place)
      type(domain_type), intent(in) :: domain
      !> The user's number of the node
      integer, intent(in) :: id
      !> Layer and level
      integer, intent(in) :: point(2)
      integer :: place(3)

      logical :: is_counted(domain%columns%count)
      integer :: node

      place(:) = 0
      node = findloc(domain%node_id, id, 1)
      if (node == 0) return
      place(:) = domain%columns%freedom(point(1), point(2), [1, 2, 3], node)
      is_counted(:) = counted_columns(domain)
      if (.not. is_counted(domain%columns%column_of(place(1)))) place(:) = 0
   end function places_of

   !> Add a line; the velocity is that of the full step
   subroutine record_nodes(self, simulation, error)
      class(node_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      integer :: first, i

      self%row(:) = 0.0_wp
      do i = 1, size(self%freedom)/3
         first = 1 + 6*(i - 1)
         if (.not. self%is_known(first + 1)) cycle
         associate (freedom => self%freedom(3*i - 2:3*i), state => simulation%state)
            self%row(first + 1:first + 3) = state%displacement(freedom)
            self%row(first + 4:first + 6) = state%velocity(freedom) &
               & + 0.5_wp*state%step_before*state%acceleration(freedom)
         end associate
      end do
      call self%comm%merge(self%is_known, self%row)
      self%row(1) = simulation%state%time
      call self%write_line(self%row, error)
   end subroutine record_nodes

end module plydyn_io_csv_node_history
