!> Doubled nodes of a rank, and where the histories of their cracks lie.
module plydyn_domain_build_cracks
   use plydyn_base_precision, only : lanes, wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_local_to_global, only : local_to_global_type
   use plydyn_domain_subdomain, only : subdomain_type
   use plydyn_element_cracked_crack_lines, only : crack_lines_type, crack_plies_type
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: build_cracks

contains

   !> Find the doubled nodes of the rank; their histories follow those of the elements
   subroutine build_cracks(model, numbering, domain, subdomain)
      type(model_type), intent(in) :: model
      type(local_to_global_type), intent(in) :: numbering
      !> Has its columns and element histories; gets its cracks
      type(domain_type), intent(inout) :: domain
      !> Gets the segments of history
      type(subdomain_type), intent(inout) :: subdomain

      integer :: z, zones

      zones = 0
      if (allocated(model%crack_zones)) zones = size(model%crack_zones)
      allocate (domain%cracks%zones(zones))
      allocate (domain%cracks%column(2, 0), domain%cracks%zone(0), domain%cracks%number(0))
      domain%cracks%first_history = domain%histories + 1
      associate (cracks => domain%cracks, group => domain%columns%order_groups(1))
         allocate (cracks%area(lanes, group%blocks, 0), cracks%is_end(lanes, group%blocks, 0))
         cracks%blocks = group%blocks
         cracks%first = group%first
         cracks%first_mass = group%first_mass
         cracks%height = domain%columns%height
         allocate (cracks%ply(lanes, group%blocks), source=0)
         where (group%layer > 0) cracks%ply(:, :) = group%layer
         do z = 1, zones
            cracks%zones(z) = new_plies(model%crack_zones(z), domain)
            call add_nodes(model%crack_zones(z), z, numbering, domain, cracks)
         end do
         cracks%own = numbering%own(cracks%column(1, :))
      end associate
      call place_histories(domain, subdomain)
   end subroutine build_cracks

   !> Constants of the plies of a zone, lane by lane
   pure type(crack_plies_type) function new_plies(zone, domain) result(self)
      type(crack_zone_type), intent(in) :: zone
      !> Has its layers
      type(domain_type), intent(in) :: domain

      integer :: b, l

      associate (layer => domain%columns%order_groups(1)%layer, layers => domain%layers)
         allocate (self%law(size(layer, 2)), self%fibre(lanes, 2, size(layer, 2)))
         self%fibre(:, 1, :) = 1.0_wp
         self%fibre(:, 2, :) = 0.0_wp
         do b = 1, size(layer, 2)
            self%law(b)%toughness = zone%toughness
            self%law(b)%debris = zone%debris
            self%law(b)%friction = zone%friction
            do l = 1, lanes
               if (layer(l, b) == 0) cycle
               associate (ply => zone%plies(layers%ply(layer(l, b))))
                  self%law(b)%strength(l, :) = ply%strength
                  self%law(b)%stiffness(l) = ply%stiffness
                  self%law(b)%thickness(l) = layers%top(layer(l, b)) - layers%bottom(layer(l, b))
                  self%fibre(l, :, b) = ply%along
               end associate
            end do
         end do
      end associate
   end function new_plies

   !> Append the doubled nodes of a zone that the rank has
   subroutine add_nodes(zone, z, numbering, domain, cracks)
      type(crack_zone_type), intent(in) :: zone
      !> Index of the zone
      integer, intent(in) :: z
      type(local_to_global_type), intent(in) :: numbering
      type(domain_type), intent(in) :: domain
      type(crack_lines_type), intent(inout) :: cracks

      integer :: b, i, k, l
      integer, allocatable :: here(:)

      here = pack([(i, i=1, size(zone%node))], numbering%node(zone%node) > 0)
      k = size(cracks%zone)
      cracks%column = reshape([cracks%column, [(numbering%node(zone%node(here(i))), &
         & numbering%node(zone%twin(here(i))), i=1, size(here))]], [2, k + size(here)])
      cracks%zone = [cracks%zone, spread(z, 1, size(here))]
      cracks%number = [cracks%number, cracks%whole + here]
      cracks%whole = cracks%whole + size(zone%node)
      associate (layer => domain%columns%order_groups(1)%layer)
         cracks%area = reshape([cracks%area, spread(0.0_wp, 1, size(layer)*size(here))], &
            & [lanes, size(layer, 2), size(cracks%zone)])
         cracks%is_end = reshape([cracks%is_end, spread(.false., 1, size(layer)*size(here))], &
            & shape(cracks%area))
         do i = 1, size(here)
            do b = 1, size(layer, 2)
               do l = 1, lanes
                  if (layer(l, b) == 0) cycle
                  associate (ply => domain%layers%ply(layer(l, b)))
                     cracks%area(l, b, k + i) = cracks%zones(z)%law(b)%thickness(l) &
                        & *zone%length(ply, here(i))
                     cracks%is_end(l, b, k + i) = zone%is_end(ply, here(i))
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine add_nodes

   !> Let the histories of all nodes follow those of the elements, here and in the whole model
   pure subroutine place_histories(domain, subdomain)
      type(domain_type), intent(inout) :: domain
      type(subdomain_type), intent(inout) :: subdomain

      integer :: i, length, n, segments(3, size(domain%cracks%zone))

      length = domain%cracks%history_length()
      n = size(segments, 2)
      do i = 1, n
         segments(:, i) = [domain%histories + 1 + length*(i - 1), subdomain%histories + 1 &
            & + length*(domain%cracks%number(i) - 1), length]
      end do
      subdomain%counts_history = [spread(.true., 1, size(subdomain%history, 2)), domain%cracks%own]
      subdomain%history = reshape([subdomain%history, segments], &
         & [3, size(subdomain%history, 2) + n])
      domain%histories = domain%histories + length*n
      subdomain%histories = subdomain%histories + length*domain%cracks%whole
   end subroutine place_histories

end module plydyn_domain_build_cracks
