!> Displacement, strain and stress through the thickness at a place of the plane,
!> JOB.profile_ID.csv.
module plydyn_io_csv_profile
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_sort, only : sorted_order
   use plydyn_base_text, only : text
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_group, only : plate_group_type
   use plydyn_element_quad, only : plane_table
   use plydyn_element_group, only : ply_stress_at, recovered, strain_at, stress_at
   use plydyn_io_csv_history_file, only : row_type
   use plydyn_io_csv_history_recorder, only : history_recorder_type
   use plydyn_io_job, only : job_type
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_control, only : profile_type
   use plydyn_state_state, only : state_type
   implicit none
   private

   !> Values at a point: displacement, stress, strain, stress in ply axes
   integer, parameter :: quantities = 21

   !> A profile being written: blocks of rows from the bottom up, one block for each time
   type, public, extends(history_recorder_type) :: profile_file_type
      !> Index of the profile
      integer :: profile = 0
      !> Points in each layer
      integer, private :: points = 0
      !> Quads of this rank that meet at the place: group and quad, and where the place is in each
      integer, allocatable, private :: quad(:, :)
      real(wp), allocatable, private :: local(:, :)
      !> Which of all that meet there each of them is, in the order of the mesh
      integer, allocatable, private :: number(:)
      !> How many all ranks have
      integer, private :: all_quads = 0
      !> The row that is written: height, ply, and values
      real(wp), private :: height = 0.0_wp, ply = 0.0_wp, value(quantities) = 0.0_wp
   contains
      procedure :: prepare
      procedure :: put_columns
      procedure :: open => open_profile
      procedure :: record
   end type profile_file_type

   !> How far outside of its square a place may be and still belong to the quad
   real(wp), parameter :: inside = 1.0_wp + 1.0e-8_wp
   !> Newton steps to find a place in a quad
   integer, parameter :: newton_steps = 20

   public :: check_profiles

contains

   !> Profiles must lie on the plate. All ranks must come here, and come to the same
   subroutine check_profiles(profiles, domain, error)
      !> Profiles of the deck
      type(profile_type), intent(in) :: profiles(:)
      !> The domain of this rank
      type(domain_type), intent(in) :: domain
      !> A place outside of the plate
      type(error_type), allocatable, intent(out) :: error

      type(profile_file_type) :: file
      logical :: is_beside
      integer :: i

      do i = 1, size(profiles)
         file = profile_file_type()
         call find_quads(file, domain, profiles(i)%position)
         is_beside = size(file%quad, 2) == 0
         call domain%comm%all_true(is_beside)
         if (.not. is_beside) cycle
         call fail(error, exit_input, "error: "//profiles(i)%place//": *DATABASE_PROFILE X: the " &
            & //"place ("//text(profiles(i)%position(1))//", "//text(profiles(i)%position(2)) &
            & //") is not on the plate: give one within an element")
         return
      end do
   end subroutine check_profiles

   subroutine prepare(self, simulation)
      class(profile_file_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation

      associate (profile => simulation%model%request%profiles(self%profile))
         self%ending = ".profile_"//text(profile%id)//".csv"
         self%interval = profile%interval
         self%points = profile%points
         self%lines = profile%points*size(simulation%domain%layers%order)
      end associate
   end subroutine prepare

   subroutine put_columns(self, simulation, row)
      class(profile_file_type), intent(in) :: self
      class(simulation_type), intent(in) :: simulation
      type(row_type), intent(inout) :: row

      character(2), parameter :: pair(6) = ["xx", "yy", "zz", "xy", "xz", "yz"], &
         & ply_pair(6) = ["11", "22", "33", "12", "13", "23"]
      character(1), parameter :: kind(6) = ["e", "e", "e", "g", "g", "g"]

      associate (unit => simulation%model%control%units, value => self%value)
         call row%put("time", unit%time, simulation%state%time)
         call row%put("z", unit%length, self%height)
         call row%put("ply", "-", self%ply)
         call row%put("u"//["x", "y", "z"], unit%length, value(:3))
         call row%put("s"//pair, unit%stress, value(4:9))
         call row%put(kind//pair, "-", value(10:15))
         call row%put("s"//ply_pair, unit%stress, value(16:))
      end associate
   end subroutine put_columns

   !> Find the place, and create the file
   subroutine open_profile(self, job, simulation, error)
      class(profile_file_type), intent(inout) :: self
      type(job_type), intent(in) :: job
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      call find_quads(self, simulation%domain, &
         & simulation%model%request%profiles(self%profile)%position)
      call number_quads(self, simulation%domain)
      call self%open_recorder(job, simulation, error)
   end subroutine open_profile

   !> All quads that contain a place, on a border more than one
   subroutine find_quads(self, domain, position)
      class(profile_file_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: position(2)

      real(wp), allocatable :: area(:)
      integer, allocatable :: node(:)
      integer :: e, g
      logical :: found
      real(wp) :: local(2)

      allocate (self%quad(2, 0), self%local(2, 0))
      do g = 1, size(domain%groups)
         associate (group => domain%groups(g)%item)
            if (.not. allocated(group%layer_spring)) cycle
            do e = 1, size(group%element)
               call group%find_nodes(e, domain%position, node, area)
               call find_local(domain%position(1:2, node), position, local, found)
               if (.not. found) cycle
               self%quad = reshape([self%quad, g, e], [2, size(self%quad, 2) + 1])
               self%local = reshape([self%local, local], [2, size(self%local, 2) + 1])
            end do
         end associate
      end do
   end subroutine find_quads

   !> Newton's method for the local coordinates of a place
   pure subroutine find_local(corner, position, local, found)
      !> Positions of the nodes in tensor order, (2, nodes), and the place
      real(wp), intent(in) :: corner(:, :), position(2)
      !> Local coordinates of the place, and whether it lies in the quad
      real(wp), intent(out) :: local(2)
      logical, intent(out) :: found

      real(wp) :: area, high(2), jacobian(2, 2), low(2), miss(2)
      real(wp) :: slope(2, size(corner, 2)), value(size(corner, 2))
      integer :: pass, side

      side = nint(sqrt(real(size(value), wp)))
      local(:) = 0.0_wp
      area = 0.0_wp
      low(:) = minval(corner, 2)
      high(:) = maxval(corner, 2)
      found = all(position >= low - (high - low)) .and. all(position <= high + (high - low))
      if (.not. found) return
      do pass = 1, newton_steps
         call plane_table(side, local(1), local(2), value, slope)
         miss(:) = position - matmul(corner, value)
         jacobian(:, :) = matmul(corner, transpose(slope))
         area = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
         ! far outside a quad its map may fold: the place is not in it
         if (area <= 0.0_wp) exit
         local(:) = local + [jacobian(2, 2)*miss(1) - jacobian(1, 2)*miss(2), &
            & jacobian(1, 1)*miss(2) - jacobian(2, 1)*miss(1)]/area
         local(:) = max(-2.0_wp, min(2.0_wp, local))
      end do
      found = area > 0.0_wp .and. all(abs(local) <= inside)
   end subroutine find_local

   !> Number the quads of all ranks at the place
   subroutine number_quads(self, domain)
      type(profile_file_type), intent(inout) :: self
      type(domain_type), intent(in) :: domain

      real(wp) :: counts(domain%comm%ranks), own(size(self%quad, 2))
      real(wp), allocatable :: all_ranks(:)
      integer :: i, r

      call domain%comm%allgather([real(size(own), wp)], [(1, r=1, size(counts))], counts)
      self%all_quads = nint(sum(counts))
      own(:) = [(real(domain%groups(self%quad(1, i))%item%element(self%quad(2, i)), wp), &
         & i=1, size(own))]
      allocate (all_ranks(self%all_quads))
      call domain%comm%allgather(own, nint(counts), all_ranks)
      all_ranks(:) = all_ranks(sorted_order(nint(all_ranks)))
      self%number = [(minloc(abs(all_ranks - own(i)), 1), i=1, size(own))]
   end subroutine number_quads

   !> Write a block of rows
   subroutine record(self, simulation, error)
      class(profile_file_type), intent(inout) :: self
      class(simulation_type), intent(in) :: simulation
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: part
      real(wp), allocatable :: values(:, :, :, :)
      integer :: i, k

      associate (layers => simulation%domain%layers)
         allocate (values(quantities, self%all_quads, self%points, size(layers%order)))
         call find_values(self, simulation%domain, simulation%state, values)
         do k = 1, size(layers%order)
            do i = 1, self%points
               part = share_of(self, i)
               self%height = (1.0_wp - part)*layers%bottom(k) + part*layers%top(k)
               self%ply = real(layers%ply(k), wp)
               self%value(:) = mean(values(:, :, i, k))
               call self%record_row(simulation, error)
               if (allocated(error)) return
            end do
         end do
      end associate
   end subroutine record

   !> Height of a point in its layer, from 0 to 1
   pure real(wp) function share_of(self, point)
      type(profile_file_type), intent(in) :: self
      integer, intent(in) :: point

      share_of = real(point - 1, wp)/real(self%points - 1, wp)
   end function share_of

   !> Mean of the values of the quads, in their order
   pure function mean(values)
      !> (quantities, quads)
      real(wp), intent(in) :: values(:, :)
      real(wp) :: mean(size(values, 1))
      integer :: i

      mean(:) = 0.0_wp
      do i = 1, size(values, 2)
         mean(:) = mean + values(:, i)
      end do
      mean(:) = mean/real(size(values, 2), wp)
   end function mean

   !> Values of the quads of all ranks
   subroutine find_values(self, domain, state, values)
      type(profile_file_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> (quantities, quads, points, layers)
      real(wp), intent(out) :: values(:, :, :, :)

      logical :: is_known(quantities, self%all_quads, self%points, size(values, 4))
      integer :: k, q

      values(:, :, :, :) = 0.0_wp
      is_known(:, :, :, :) = .false.
      is_known(:, self%number, :, :) = .true.
      do q = 1, size(self%number)
         do k = 1, size(values, 4)
            values(:, self%number(q), :, k) = layer_profile(self, domain, state, q, k)
         end do
      end do
      call domain%comm%merge(size(values), is_known, values)
   end subroutine find_values

   !> Displacement, stress, strain and ply stress of a quad at the points of a layer
   pure function layer_profile(self, domain, state, q, layer) result(values)
      type(profile_file_type), intent(in) :: self
      type(domain_type), intent(in) :: domain
      type(state_type), intent(in) :: state
      !> The quad among those of this rank at the place
      integer, intent(in) :: q, layer
      real(wp) :: values(quantities, self%points)

      integer, parameter :: chosen(quantities) = [1, 2, 3, &
         & 3 + stress_at + [1, 2, 3, 4, 5, 6], 3 + strain_at + [1, 2, 3, 4, 5, 6], &
         & 3 + ply_stress_at + [1, 2, 3, 4, 5, 6]]
      real(wp) :: all_values(3 + recovered, self%points)
      integer :: i

      select type (group => domain%groups(self%quad(1, q))%item)
      class is (plate_group_type)
         all_values(:, :) = group%profile(domain%columns, [self%quad(2, q), layer], &
            & self%local(:, q), [(2.0_wp*share_of(self, i) - 1.0_wp, i=1, self%points)], &
            & state%displacement, state%history)
      end select
      values(:, :) = all_values(chosen, :)
   end function layer_profile

end module plydyn_io_csv_profile
