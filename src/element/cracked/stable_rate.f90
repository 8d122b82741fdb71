!> Bounds on the eigenvalues of wedges and of open cracks.
!>
!> The mass of a quad is parted among its wedges: a corner that both have goes to both by halves.
!> Then no eigenvalue of the mesh is above the largest of any wedge, whichever corners cracks have
!> parted.
module plydyn_element_cracked_stable_rate
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_cracked_cells, only : cells_type, corners, wedge_metric, wedges
   use plydyn_element_cracked_stresses, only : find_stresses
   use plydyn_element_cracked_wedges, only : add_point_forces, faces, find_gradients, wedge_points
   use plydyn_element_plate_layers, only : first_degree, plate_type
   use plydyn_element_plate_masses, only : surface_density
   use plydyn_element_stable_step, only : certified_bound, power_iteration
   use plydyn_model_crack_zone, only : crack_zone_type
   use plydyn_model_layers, only : layers_type, new_layers
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: crack_rate, wedge_rate

   !> Freedoms of a quad of one layer
   integer, parameter :: freedoms = 3*faces*corners

contains

   !> Largest eigenvalue of the quads of a zone, which are all of one shape, and the ply that has
   !> it, the user's number
   subroutine wedge_rate(model, zone, plate, cells, rate, ply)
      !> The model and one of its zones
      type(model_type), intent(in) :: model
      type(crack_zone_type), intent(in) :: zone
      !> Its plate and its division
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      !> Eigenvalue
      real(wp), intent(out) :: rate
      !> The ply
      integer, intent(out) :: ply

      type(plate_type) :: elastic
      type(cells_type) :: one
      type(layers_type) :: layers
      real(wp) :: bound
      real(wp), allocatable :: density(:, :)
      integer :: b, l, parity

      layers = new_layers(model%parts(zone%part))
      density = surface_density(model, zone%part, layers, plate%batches(1)%layer)
      call single_quad(zone, plate, cells, elastic, one)
      rate = 0.0_wp
      ply = 0
      do parity = 1, 2
         one%parity(:) = parity
         do b = 1, plate%batches(1)%blocks
            do l = 1, lanes
               if (plate%batches(1)%layer(l, b) == 0) cycle
               bound = layer_bound(elastic, one, b, l, density(l, b))
               if (bound <= rate) cycle
               rate = bound
               ply = model%parts(zone%part)%plies(layers%ply(plate%batches(1)%layer(l, b)))%id
            end do
         end do
      end do
   end subroutine wedge_rate

   !> One quad of a zone alone, elastic and without twins
   pure subroutine single_quad(zone, plate, cells, elastic, one)
      type(crack_zone_type), intent(in) :: zone
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      type(plate_type), intent(out) :: elastic
      type(cells_type), intent(out) :: one

      integer :: c

      elastic = plate
      elastic%metric = wedge_metric(zone, 1)
      elastic%node = reshape([(c, c=1, corners)], [corners, 1])
      elastic%target = elastic%node
      deallocate (elastic%batches(1)%laws)
      allocate (elastic%batches(1)%laws(0))
      elastic%batches(1)%first = 1
      elastic%batches(1)%height = 3*lanes*faces*plate%batches(1)%blocks
      one%first = cells%first
      one%twin = elastic%node
      one%twin_target = elastic%node
      allocate (one%parity(1), source=1)
      allocate (one%is_doubled(1), source=.false.)
      allocate (one%sees(0, 0, 0, 0, 0))
   end subroutine single_quad

   !> Bound of both wedges of one layer
   real(wp) function layer_bound(plate, cells, block, lane, density) result(bound)
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      integer, intent(in) :: block, lane
      !> Mass per area
      real(wp), intent(in) :: density

      real(wp) :: k(freedoms, freedoms), mass(freedoms)
      integer :: i, w
      integer, allocatable :: here(:)

      bound = 0.0_wp
      do w = 1, wedges
         call wedge_stiffness(plate, cells, block, lane, w, k)
         mass(:) = wedge_mass(w, cells%first(lane, block, cells%parity(1)) > 0.0_wp, &
            & sum(plate%metric(5, :, 1))*density)
         here = pack([(i, i=1, freedoms)], mass > 0.0_wp)
         do i = 1, size(here)
            k(here, here(i)) = k(here, here(i))/sqrt(mass(here)*mass(here(i)))
         end do
         associate (own => k(here, here))
            bound = max(bound, certified_bound(own, power_iteration(own)))
         end associate
      end do
   end function layer_bound

   !> Stiffness of one wedge of a layer; freedoms run over corners, faces, directions
   subroutine wedge_stiffness(plate, cells, block, lane, wedge, k)
      type(plate_type), intent(in) :: plate
      type(cells_type), intent(in) :: cells
      integer, intent(in) :: block, lane, wedge
      real(wp), intent(out) :: k(freedoms, freedoms)

      real(wp) :: force(plate%batches(1)%height*corners), history(1)
      real(wp), dimension(lanes, 3, 3, wedge_points) :: gradient, stress
      real(wp) :: motion(plate%batches(1)%height*corners)
      integer :: c, d, i, place(freedoms), t

      place(:) = [(((lane - 1 + first_degree(plate%batches(1), block, c, t, d), d=1, 3), &
         & t=1, faces), c=1, corners)]
      do i = 1, freedoms
         motion(:) = 0.0_wp
         motion(place(i)) = 1.0_wp
         force(:) = 0.0_wp
         call find_gradients(plate, cells, block, 1, motion, gradient)
         call find_stresses(plate, block, 1, .false., 0.0_wp, gradient, history, stress)
         stress(:, :, :, faces*(wedges - wedge) + 1:faces*(wedges - wedge + 1)) = 0.0_wp
         call add_point_forces(plate, cells, block, 1, stress, force)
         k(:, i) = -force(place)
      end do
   end subroutine wedge_stiffness

   !> Mass of each freedom of one wedge, 0 where it has none
   pure function wedge_mass(wedge, first, whole) result(mass)
      integer, intent(in) :: wedge
      !> Whether the diagonal from the first corner divides the quad
      logical, intent(in) :: first
      !> Mass of the quad
      real(wp), intent(in) :: whole
      real(wp) :: mass(freedoms)

      real(wp) :: share(corners)
      integer :: c

      ! both ends of the diagonal go to both wedges
      if (first) then
         share(:) = [0.5_wp, merge(1.0_wp, 0.0_wp, wedge == 1), merge(0.0_wp, 1.0_wp, wedge == 1), &
            & 0.5_wp]
      else
         share(:) = [merge(1.0_wp, 0.0_wp, wedge == 1), 0.5_wp, 0.5_wp, &
            & merge(0.0_wp, 1.0_wp, wedge == 1)]
      end if
      mass(:) = [(spread(share(c)*whole/real(corners*faces, wp), 1, 3*faces), c=1, corners)]
   end function wedge_mass

   !> Largest eigenvalue of the springs of open cracks: traction per opening over both masses
   pure real(wp) function crack_rate(model, zone) result(rate)
      type(model_type), intent(in) :: model
      !> One of its zones
      type(crack_zone_type), intent(in) :: zone

      integer :: p

      rate = 0.0_wp
      do p = 1, size(zone%plies)
         associate (ply => zone%plies(p), &
            & material => model%materials(model%parts(zone%part)%plies(p)%material))
            rate = max(rate, 4.0_wp*ply%stiffness/(material%density*ply%pitch))
         end associate
      end do
   end function crack_rate

end module plydyn_element_cracked_stable_rate
