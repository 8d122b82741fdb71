!> Sets up a run from its model, on one rank or on several, with its state at time zero, and its
!> threads: results are the same to the last bit for any number of them.
module plydyn_run_setup
   use omp_lib, only : omp_get_max_threads, omp_get_num_procs, omp_set_dynamic, &
      & omp_set_num_threads
   use plydyn_base_error, only : error_type, exit_run, fail
   use plydyn_base_limits, only : available_memory
   use plydyn_base_memory, only : clear_pages
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_crack_band_widths, only : check_bands
   use plydyn_domain_build, only : begin_domain, build_subdomain, start_histories
   use plydyn_domain_build_elements, only : whole_mass
   use plydyn_domain_rank_partition, only : divide_ranks
   use plydyn_domain_decomposition, only : decomposition_type
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_memory, only : history_bytes, least_bytes, mesh_bytes, motion_bytes
   use plydyn_domain_subdomain, only : subdomain_type
   use plydyn_io_csv_profile, only : check_profiles
   use plydyn_io_listing_effort, only : rank_numbers
   use plydyn_io_checkpoint_state_layout, only : new_state_layout, state_layout_type
   use plydyn_parallel_comm, only : comm_type
   use plydyn_method_contact_setup, only : new_contacts
   use plydyn_method_simulation, only : simulation_type
   use plydyn_model_model, only : model_type
   use plydyn_model_symmetry, only : find_planes
   use plydyn_method_constraints, only : begin_constraints
   use plydyn_method_supports, only : support_points
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: choose_threads, most_threads, new_state, set_threads, set_up

   !> A simulation, and how it is shared by the ranks
   type, public, extends(simulation_type) :: run_type
      !> Which places of the arrays of the whole model this rank has
      type(state_layout_type) :: state_parts
      !> Size of the part of each rank; see `write_ranks`. Empty with one rank
      real(wp), allocatable :: ranks(:, :)
   end type run_type

contains

   !> Build everything; the state is that at time zero
   subroutine set_up(comm, self, error)
      type(comm_type), intent(in) :: comm
      !> Has the model, gets the rest
      type(run_type), intent(inout) :: self
      !> A request of the model that cannot be met; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(decomposition_type) :: division
      integer, allocatable :: rank_of_chunk(:)
      type(subdomain_type) :: subdomain

      call check_memory(comm, least_bytes(self%model)/comm%ranks, error)
      if (allocated(error)) return
      self%model%planes(:) = find_planes(self%model)
      allocate (self%domain)
      call begin_domain(self%model, self%domain, division)
      self%domain%comm = comm
      call divide_ranks(self%domain, division, comm%ranks, rank_of_chunk)
      call comm%broadcast(rank_of_chunk)
      call build_subdomain(self%model, division, rank_of_chunk, self%domain, subdomain, error)
      if (allocated(error)) return
      self%domain%inertia%total_mass = whole_mass(self%domain)
      call check_bands(self%model, self%domain, error)
      if (allocated(error)) return
      call check_profiles(self%model%request%profiles, self%domain, error)
      if (allocated(error)) return
      call count_ranks(comm, self%domain, self%ranks)
      self%state_parts = new_state_layout(self%domain, subdomain)
      ! the cost of a step is measured with a copy
      call check_memory(comm, 2.0_wp*(motion_bytes(self%domain) + history_bytes(self%domain)), &
         & error)
      if (allocated(error)) return
      call new_state(self%model, self%domain, self%state)
      call new_contacts(self%domain, self%state, self%contacts, error)
   end subroutine set_up

   !> Refuse what the machine of any rank has no memory for
   subroutine check_memory(comm, bytes, error)
      type(comm_type), intent(in) :: comm
      !> Memory that this rank will take at least
      real(wp), intent(in) :: bytes
      !> Says how much is missing; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      if (bytes > available_memory()) call fail(error, exit_run, "out of memory: the model takes " &
         & //gigabytes(bytes)//" more at least, and "//gigabytes(available_memory()) &
         & //" are free; right would be fewer quads, plies or layers in a ply (NSUB, ORDER of " &
         & //"*SECTION_LAYERWISE), or ranks on more machines")
      call comm%broadcast_error(error)

   contains

      !> A size in words
      function gigabytes(size) result(words)
         real(wp), intent(in) :: size
         character(:), allocatable :: words

         words = text(size/1.0e9_wp, 3)//" GB"
      end function gigabytes

   end subroutine check_memory

   !> Size of the part of each rank; empty with one rank
   subroutine count_ranks(comm, domain, ranks)
      type(comm_type), intent(in) :: comm
      type(domain_type), intent(in) :: domain
      !> See `write_ranks`
      real(wp), allocatable, intent(out) :: ranks(:, :)

      real(wp) :: all(rank_numbers*comm%ranks), own(rank_numbers)
      integer :: r

      if (comm%ranks == 1) then
         allocate (ranks(rank_numbers, 0))
         return
      end if
      own(:) = [real(size(domain%chunks%list), wp), real(domain%columns%count, wp), &
         & real(count(.not. domain%chunks%counted), wp), &
         & real(max(domain%chunks%halo%neighbours(), domain%averaging%strain_halo%neighbours()), &
         & wp), &
         & real(domain%chunks%halo%bytes + domain%averaging%strain_halo%bytes, wp), &
         & mesh_bytes(domain), history_bytes(domain)]
      call comm%allgather(own, [(rank_numbers, r=1, comm%ranks)], all)
      ranks = reshape(all, [rank_numbers, comm%ranks])
   end subroutine count_ranks

   !> Points and impactors where they begin, with the velocity that the deck gives them
   subroutine new_state(model, domain, state)
      !> The model, and its domain
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      type(state_type), intent(out) :: state

      integer :: i

      state%supports%planes(:) = model%planes
      state%end%time = domain%control%end_time
      state%end%cycle = domain%control%end_cycle
      associate (n => domain%columns%freedoms)
         allocate (state%displacement(n), state%velocity(n), source=0.0_wp)
      end associate
      allocate (state%acceleration(domain%columns%forces), source=0.0_wp)
      allocate (state%history(domain%histories + domain%averaging%halo_strains))
      call clear_pages(state%history)
      call start_histories(model, domain, state%history)
      allocate (state%supports%load_factor(size(domain%loads)), source=0.0_wp)
      allocate (state%supports%force(support_points(domain)), source=0.0_wp)
      call set_velocities(domain, state%velocity)
      allocate (state%supports%velocity(0))
      do i = 1, size(domain%supports%motions)
         state%supports%velocity = [state%supports%velocity, &
            & state%velocity(domain%supports%motions(i)%freedom)]
      end do
      call begin_constraints(domain, state%velocity, state%supports%constraints)
      allocate (state%fixtures(size(domain%contact%fixtures)))
      state%fixtures(:)%id = domain%contact%fixtures(:)%id
      state%fixtures(:)%height = domain%contact%fixtures(:)%height
      allocate (state%contacts(size(domain%contact%contacts)))
      allocate (state%impactors(size(domain%contact%impactors)))
      state%impactors(:)%id = domain%contact%impactors(:)%id
      do i = 1, size(domain%contact%impactors)
         state%impactors(i)%centre(:) = domain%contact%impactors(i)%centre
         state%impactors(i)%velocity(:) = domain%contact%impactors(i)%velocity
      end do
   end subroutine new_state

   !> Initial velocities of whole columns; held points keep still
   subroutine set_velocities(domain, velocity)
      type(domain_type), intent(in) :: domain
      real(wp), intent(inout) :: velocity(:)

      integer :: i, k, t

      do i = 1, size(domain%supports%initial_velocities)
         associate (initial => domain%supports%initial_velocities(i))
            do k = 1, size(domain%columns%layer_slot, 2)
               do t = 1, domain%columns%levels(k)
                  velocity(domain%columns%freedom(k, t, 1, initial%nodes)) = initial%velocity(1)
                  velocity(domain%columns%freedom(k, t, 2, initial%nodes)) = initial%velocity(2)
                  velocity(domain%columns%freedom(k, t, 3, initial%nodes)) = initial%velocity(3)
               end do
            end do
         end associate
      end do
      velocity(domain%supports%held) = 0.0_wp
   end subroutine set_velocities

   !> Number of threads: from the command line, else the deck, else OMP_NUM_THREADS, else one
   integer function choose_threads(command, deck) result(threads)
      !> Threads that the command line and the deck ask for; 0 for no request
      integer, intent(in) :: command, deck

      integer :: length

      threads = 1
      call get_environment_variable("OMP_NUM_THREADS", length=length)
      if (length > 0) threads = omp_get_max_threads()
      if (deck > 0) threads = deck
      if (command > 0) threads = command
   end function choose_threads

   !> Most threads that a run may ask for: more take memory and only slow each other down
   integer function most_threads()
      !> For each processor, and on machines of few
      integer, parameter :: per_processor = 16, at_least = 256

      most_threads = max(at_least, per_processor*omp_get_num_procs())
   end function most_threads

   !> Let the loops run on so many threads
   subroutine set_threads(threads)
      !> How many
      integer, intent(in) :: threads

      call omp_set_dynamic(.false.)
      call omp_set_num_threads(threads)
   end subroutine set_threads

end module plydyn_run_setup
