!> The history of single nodes on both faces of the plate, JOB.nodes.csv.
module plydyn_io_csv_node_history
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_supports, only : face_point
   use plydyn_model_support, only : bottom_face, top_face
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Most characters of the name of a point
   integer, parameter :: name_length = 24

   !> The history of some nodes
   type, public, extends(history_recorder_type) :: node_history_type
      private
      !> Names of the points, such as `n17 top`
      character(name_length), allocatable :: name(:)
      !> Places in the arrays of motion, 0 where another rank counts the point, (3, points)
      integer, allocatable :: freedom(:, :)
   contains
      procedure :: prepare
      procedure :: put_columns
   end type node_history_type

contains

   !> Find the points, if the deck asks for any
   subroutine prepare(self, simulation)
      class(node_history_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      character(7), parameter :: face_name(2) = [" bottom", " top   "]
      integer :: face, i, k

      associate (domain => simulation%domain, request => simulation%model%request)
         if (size(request%nodes) == 0) return
         self%ending = ".nodes.csv"
         self%interval = request%node_interval
         ! the node of an element in space is one point
         associate (faces => merge(2, 1, any(domain%layers%order > 0)))
            allocate (self%name(faces*size(request%nodes)))
            allocate (self%freedom(3, size(self%name)))
            do k = 1, size(self%name)
               i = (k - 1)/faces + 1
               face = k - faces*(i - 1)
               associate (id => simulation%model%mesh%node_id(request%nodes(i)))
                  self%name(k) = "n"//text(id)
                  if (faces > 1) self%name(k) = "n"//text(id)//trim(face_name(face))
                  self%freedom(:, k) = places_of(domain, id, face_point(domain%layers, &
                     & merge(bottom_face, top_face, face == 1)))
               end associate
            end do
         end associate
      end associate
   end subroutine prepare

   !> Places of a point above a node in the arrays of motion; 0 where this rank does not count it
   function places_of(domain, id, point) result(place)
      type(domain_type), intent(in) :: domain
      !> The user's number of the node
      integer, intent(in) :: id
      !> Layer and level
      integer, intent(in) :: point(2)
      integer :: place(3)

      integer :: node

      place(:) = 0
      node = findloc(domain%node_id, id, 1)
      if (node == 0) return
      place(:) = domain%columns%freedom(point(1), point(2), [1, 2, 3], node)
      if (.not. domain%counts(place(1))) place(:) = 0
   end function places_of

   !> Displacement and velocity of each point, such as `n17 top uz`; the velocity is that of the
   !> full step
   subroutine put_columns(self, simulation, row)
      class(node_history_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(3), parameter :: axis(6) = [" ux", " uy", " uz", " vx", " vy", " vz"]
      real(wp) :: motion(6*size(self%name))
      integer :: k

      motion(:) = 0.0_wp
      if (.not. row%is_heading) call find_motion(self, simulation%state, motion)
      associate (unit => simulation%model%control%units)
         call row%put("time", unit%time, simulation%state%time)
         do k = 1, size(self%name)
            call row%put(trim(self%name(k))//axis(:3), unit%length, motion(6*k - 5:6*k - 3))
            call row%put(trim(self%name(k))//axis(4:), unit%velocity(), motion(6*k - 2:6*k))
         end do
      end associate
   end subroutine put_columns

   !> Motion of all points, the same on all ranks
   subroutine find_motion(self, state, motion)
      type(node_history_type), intent(in) :: self
      type(state_type), intent(in) :: state
      !> Displacement and velocity of each point, zero in
      real(wp), intent(inout) :: motion(:)

      logical :: is_known(size(motion))
      integer :: k

      do k = 1, size(self%name)
         is_known(6*k - 5:6*k) = self%freedom(1, k) > 0
         if (self%freedom(1, k) == 0) cycle
         associate (freedom => self%freedom(:, k))
            motion(6*k - 5:6*k - 3) = state%displacement(freedom)
            motion(6*k - 2:6*k) = state%velocity(freedom) &
               & + 0.5_wp*state%step_before*state%acceleration(freedom)
         end associate
      end do
      call self%comm%merge(size(motion), is_known, motion)
   end subroutine find_motion

end module plydyn_io_csv_node_history
