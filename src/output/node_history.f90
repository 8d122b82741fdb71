!> Motion of single nodes on both faces of the plate, as a history.
module plydyn_output_node_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_supports, only : face_point
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : bottom_face, top_face
   use plydyn_output_places, only : places_type
   use plydyn_output_recorder, only : recorder_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> The history of some nodes
   type, public, extends(recorder_type) :: node_history_type
      private
      !> Places in the arrays of motion, and the row that they fill
      integer, allocatable :: freedom(:)
      real(wp), allocatable :: row(:)
   contains
      procedure :: open => open_nodes
      procedure :: record => record_nodes
   end type node_history_type

contains

   !> Create the file, if the deck asks for nodes
   subroutine open_nodes(self, path, model, domain, places, error)
      class(node_history_type), intent(inout) :: self
      !> Path of the file
      character(*), intent(in) :: path
      !> The model
      type(model_type), intent(in) :: model
      !> The domain
      type(domain_type), intent(in) :: domain
      !> Where to go on with files of an earlier run
      type(places_type), intent(in) :: places
      !> Why it could not be created
      type(error_type), allocatable, intent(out) :: error

      character(2), parameter :: motion(6) = ["ux", "uy", "uz", "vx", "vy", "vz"]
      character(6), parameter :: face_name(2) = ["bottom", "top   "]
      character(40) :: names(1 + 12*size(model%request%nodes)), units(size(names))
      integer :: c, face, faces, i, k, point(2)

      allocate (self%freedom(0))
      names(1) = "time"
      units(1) = model%control%units%time
      k = 1
      ! a brick's node is one point
      faces = merge(1, 2, size(domain%bricks) > 0)
      do i = 1, size(model%request%nodes)
         do face = 1, faces
            point(:) = face_point(domain%layers, merge(bottom_face, top_face, face == 1))
            do c = 1, size(motion)
               k = k + 1
               names(k) = "n"//text(model%mesh%node_id(model%request%nodes(i)))//" " &
                  & //motion(c)
               if (faces > 1) names(k) = "n"//text(model%mesh%node_id(model%request%nodes(i))) &
                  & //" "//trim(face_name(face))//" "//motion(c)
               units(k) = model%control%units%length
               if (c > 3) units(k) = trim(units(k))//"/"//model%control%units%time
            end do
            self%freedom = [self%freedom, domain%columns%freedom(point(1), point(2), &
               & [1, 2, 3], model%request%nodes(i))]
         end do
      end do
      allocate (self%row(k))
      if (size(model%request%nodes) == 0) return
      call self%history%open(path, names(:k), units(:k), model%request%node_interval, places, &
         & error)
   end subroutine open_nodes

   !> Add a line if one is due; the velocity is that of this time
   subroutine record_nodes(self, state, is_last, error)
      class(node_history_type), intent(inout) :: self
      !> The state
      type(state_type), intent(in) :: state
      !> Whether the run ends here
      logical, intent(in) :: is_last
      !> Why it could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: first, i

      if (.not. self%history%is_open()) return
      if (.not. (self%history%due(state%time) .or. is_last)) return
      self%row(1) = state%time
      do i = 1, size(self%freedom)/3
         first = 1 + 6*(i - 1)
         associate (freedom => self%freedom(3*i - 2:3*i))
            self%row(first + 1:first + 3) = state%displacement(freedom)
            self%row(first + 4:first + 6) = state%velocity(freedom) &
               & + 0.5_wp*state%step_before*state%acceleration(freedom)
         end associate
      end do
      call self%history%record(state%time, self%row, error)
   end subroutine record_nodes

end module plydyn_output_node_history
