!> From the model to the domain of a rank.
!>
!> All ranks have what grows with the mesh of the plane: nodes, quads, chunks and their ranks.
!> What grows with the columns above it, each rank builds for its share alone.
module plydyn_domain_build
   use plydyn_base_error, only : error_type, exit_input, fail
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_domain_averages, only : build_averages
   use plydyn_domain_crack_band_widths, only : check_bands, find_bands
   use plydyn_domain_build_cracks, only : build_cracks
   use plydyn_domain_build_surfaces, only : build_fixtures, build_surfaces
   use plydyn_domain_build_groups, only : build_groups
   use plydyn_domain_build_elements, only : build_elements, build_masses, invert_masses
   use plydyn_domain_build_inertia, only : build_inertia, largest_step
   use plydyn_domain_chunks, only : assign_held_points, set_targets
   use plydyn_domain_decomposition, only : column_owners, decomposition_type
   use plydyn_domain_supports, only : build_constraints, build_supports
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_loads, only : build_loads
   use plydyn_domain_local_to_global, only : new_local_to_global, local_to_global_type
   use plydyn_domain_mass_scaling, only : scale_masses
   use plydyn_domain_subdomain, only : join_ranks, renumber_chunks, subdomain_type, take_chunks, &
      & take_columns
   use plydyn_domain_step_limit, only : find_step_limit
   use plydyn_model_layers, only : new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: begin_domain, build_domain, build_subdomain, start_histories

contains

   !> The whole model as the domain of one rank
   subroutine build_domain(model, domain, error)
      type(model_type), intent(in) :: model
      type(domain_type), intent(out) :: domain
      !> What the model asks for and the domain cannot be
      type(error_type), allocatable, intent(out) :: error

      type(decomposition_type) :: division
      type(subdomain_type) :: subdomain

      call begin_domain(model, domain, division)
      call build_subdomain(model, division, spread(0, 1, size(division%chunks)), domain, &
         & subdomain, error)
      if (.not. allocated(error)) call check_bands(model, domain, error)
   end subroutine build_domain

   !> What all ranks have before the model is divided: layers, laws and chunks
   subroutine begin_domain(model, domain, division)
      type(model_type), intent(in) :: model
      !> The domain, without elements and points
      type(domain_type), intent(out) :: domain
      !> The chunks of the whole model
      type(decomposition_type), intent(out) :: division

      domain%control = model%control
      domain%curves = model%curves
      domain%contact%impactors = model%impactors
      domain%contact%contacts = model%contacts
      domain%layers = new_layers(model%parts(1))
      call build_groups(model, domain, division)
   end subroutine begin_domain

   !> Build what one rank has. All ranks must come here
   subroutine build_subdomain(model, division, rank_of_chunk, domain, subdomain, error)
      type(model_type), intent(in) :: model
      !> All chunks
      type(decomposition_type), intent(in) :: division
      !> Rank of each chunk
      integer, intent(in) :: rank_of_chunk(:)
      !> Begun, and knows its rank; gets all the rest
      type(domain_type), intent(inout) :: domain
      !> What it has of the whole model
      type(subdomain_type), intent(out) :: subdomain
      !> What neighbours cannot be averaged over; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      type(local_to_global_type) :: numbering

      numbering = new_local_to_global(division, domain%columns%nodes_per_column, &
         & column_owners(division, rank_of_chunk), domain%comm%rank)
      call take_columns(model%mesh, division, numbering, domain, subdomain)
      call take_chunks(division, rank_of_chunk == domain%comm%rank, domain)
      call build_masses(model, division, numbering, domain)
      call build_elements(model, division, numbering, domain, subdomain)
      call build_cracks(model, numbering, domain, subdomain)
      call limit_step(model, division, numbering, domain, error)
      if (allocated(error)) return
      call invert_masses(domain)
      domain%crack_bands = find_bands(model, domain)
      call build_averages(model, division, rank_of_chunk, domain, error)
      if (allocated(error)) return
      call renumber_chunks(numbering, domain)
      call set_targets(domain)
      call build_supports(model, numbering, domain)
      call assign_held_points(domain)
      call build_loads(model, numbering, domain)
      call build_inertia(model, division, numbering, domain)
      call build_constraints(model%constraints, numbering, domain)
      call build_surfaces(model, numbering, domain)
      call build_fixtures(model, numbering, domain)
      call join_ranks(division, numbering, domain)
   end subroutine build_subdomain

   !> Let the laws of all elements start their histories, with the damage that the deck asks for
   pure subroutine start_histories(model, domain, history)
      type(model_type), intent(in) :: model
      type(domain_type), intent(in) :: domain
      !> History of all Gauss points, zero in
      real(wp), intent(inout), contiguous :: history(:)

      integer :: g

      do g = 1, size(domain%groups)
         call domain%groups(g)%item%start_history(model, history)
      end do
   end subroutine start_histories

   !> The stable step, to which each rank adds what its own elements ask for, and mass for a larger
   !> one
   subroutine limit_step(model, division, numbering, domain, error)
      type(model_type), intent(in) :: model
      !> As in `build_subdomain`
      type(decomposition_type), intent(in) :: division
      type(local_to_global_type), intent(in) :: numbering
      !> Has its elements and masses
      type(domain_type), intent(inout) :: domain
      !> Says that there is none; the same on all ranks
      type(error_type), allocatable, intent(out) :: error

      domain%limit = find_step_limit(model, domain)
      call scale_masses(model, division, numbering, domain)
      domain%step = largest_step(domain)
      ! a step that does not move the time is none
      if (domain%limit%step > epsilon(1.0_wp)*domain%control%end_time) then
         call check_bounds(domain, error)
         return
      end if
      call fail(error, exit_input, "error: no stable step can be found that gets to the end: " &
         & //"element "//text(domain%limit%element_id)//" asks for "//text(domain%limit%step) &
         & //", and ENDTIM is "//text(domain%control%end_time)//new_line("a")//"  right would " &
         & //"be: plies, quads, densities, stiffnesses and an end time in proportion and in one " &
         & //"system of units")
   end subroutine limit_step

   !> Refuse bounds on the step that would all but stop the time
   subroutine check_bounds(domain, error)
      type(domain_type), intent(in) :: domain
      !> Says which bound
      type(error_type), allocatable, intent(out) :: error

      !> Least share of the stable step
      real(wp), parameter :: least_share = 1.0e-6_wp
      !> Damping times the step, at which central differences reverse a velocity
      real(wp), parameter :: most_damping = 2.0_wp
      character(:), allocatable :: right
      real(wp) :: bound

      right = new_line("a")//"  right would be: a bound of at least "//text(least_share) &
         & //" of the stable step, which is "//text(domain%limit%step)
      associate (control => domain%control)
         bound = control%largest_step
         if (bound > 0.0_wp .and. bound < least_share*domain%limit%step) then
            call fail(error, exit_input, "error: "//control%step_place//": *CONTROL_LAYERWISE " &
               & //"DTMAX: the step cannot be as small as "//text(bound)//right)
         else if (control%step_curve > 0) then
            bound = domain%curves(control%step_curve)%least(0.0_wp, control%end_time)
            if (bound < least_share*domain%limit%step) call fail(error, exit_input, "error: " &
               & //control%curve_place//": *CONTROL_TIMESTEP LCTM: the curve bounds the step by " &
               & //text(bound)//right)
         end if
         if (allocated(error) .or. control%damping*domain%step < most_damping) return
         call fail(error, exit_input, "error: "//control%damping_place//": *DAMPING_GLOBAL " &
            & //"VALDMP: damping of "//text(control%damping)//" reverses velocities in each " &
            & //"step of "//text(domain%step)//new_line("a")//"  right would be: far below " &
            & //text(most_damping/domain%step)//", such as the angular frequency of the motion " &
            & //"that is to be damped")
      end associate
   end subroutine check_bounds

end module plydyn_domain_build
