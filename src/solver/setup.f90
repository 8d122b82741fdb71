!> From the model to all that a run needs, on one rank or on several.
module plydyn_solver_setup
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_averages, only : refuse_ranks
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_divide_ranks, only : divide_ranks
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_share, only : share_type, take_share
   use plydyn_model_model, only : model_type
   use plydyn_output_profile, only : check_profiles
   use plydyn_output_ranks_listing, only : rank_numbers
   use plydyn_parallel_comm, only : comm_type
   use plydyn_solver_assembly, only : assembly_type, new_assembly
   use plydyn_solver_contacts, only : contacts_type, new_contacts
   use plydyn_solver_start, only : new_state
   use plydyn_state_state, only : state_type
   implicit none
   private

   public :: set_up

   !> What a run needs
   type, public :: run_type
      !> The deck's model
      type(model_type) :: model
      !> The domain of this rank, its contacts and its state
      type(domain_type), allocatable :: domain
      type(contacts_type) :: contacts
      type(state_type) :: state
      !> The whole model, on the root of several ranks
      type(domain_type), allocatable :: whole
      !> How the parts of several ranks come together
      type(assembly_type) :: assembly
      !> What each rank has; see `write_ranks`. None with one rank
      real(wp), allocatable :: ranks(:, :)
   end type run_type

contains

   !> Build everything; the state is that at time zero
   subroutine set_up(comm, self, error)
      !> The ranks
      type(comm_type), intent(in) :: comm
      !> Has the model, gets the rest
      type(run_type), intent(inout) :: self
      !> What the model asks for and a run cannot be; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      call refuse_ranks(self%model%materials, comm%ranks, error)
      if (allocated(error)) return
      allocate (self%whole)
      call build_domain(self%model, self%whole, error)
      if (allocated(error)) return
      call check_profiles(self%model%request%profiles, self%whole, error)
      if (allocated(error)) return
      if (comm%ranks == 1) then
         call move_alloc(self%whole, self%domain)
         allocate (self%ranks(rank_numbers, 0))
      else
         call share_out(comm, self)
      end if
      call new_contacts(self%domain, self%contacts, error)
      if (allocated(error)) return
      self%state = new_state(self%model, self%domain)
   end subroutine set_up

   !> Give every rank its share
   subroutine share_out(comm, self)
      type(comm_type), intent(in) :: comm
      type(run_type), intent(inout) :: self

      integer, allocatable :: rank_of_chunk(:)
      real(wp) :: all(rank_numbers*comm%ranks), own(rank_numbers)
      type(share_type) :: share
      integer :: r

      call divide_ranks(self%whole, comm%ranks, rank_of_chunk)
      call comm%tell(rank_of_chunk)
      allocate (self%domain)
      call take_share(self%whole, rank_of_chunk, comm, self%domain, share)
      self%assembly = new_assembly(self%domain, self%whole, share)
      if (.not. comm%is_root()) deallocate (self%whole)
      associate (domain => self%domain)
         own(:) = [real(size(domain%chunks), wp), real(size(share%own), wp), &
            & real(count(.not. share%own), wp), real(domain%halo%neighbours(), wp), &
            & real(domain%halo%bytes, wp)]
      end associate
      call comm%collect(own, [(rank_numbers, r=1, comm%ranks)], all)
      self%ranks = reshape(all, [rank_numbers, comm%ranks])
   end subroutine share_out

end module plydyn_solver_setup
