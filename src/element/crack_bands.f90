!> Crack bands of a material over the Gauss points of a mesh: their narrowest and widest widths.
module plydyn_element_crack_bands
   use plydyn_base_precision, only : wp
   use plydyn_law_ply_crack_band, only : modes
   use plydyn_model_material, only : material_type
   implicit none
   private

   public :: add_band_points, widen

   !> Crack bands of a material, each for fibres and for matrix
   type, public :: crack_band_type
      !> Narrowest and widest
      real(wp) :: narrowest(2) = huge(1.0_wp), widest(2) = 0.0_wp
      !> Element of the mesh, ply from the bottom of its part and element group where the widest is:
      !> the first such element, and its lowest ply
      integer :: element(2) = 0, ply(2) = 0, group(2) = 0
      !> Gauss points, and those of them where the band is too wide, by mode
      integer :: points = 0, too_wide(modes) = 0
   end type crack_band_type

contains

   !> Add the bands of points with one width, such as those above each other in a layer
   pure subroutine add_band_points(material, place, length, points, band)
      !> Their material
      type(material_type), intent(in) :: material
      !> Element, ply and group
      integer, intent(in) :: place(3)
      !> Widths for fibres and for matrix
      real(wp), intent(in) :: length(2)
      !> How many points
      integer, intent(in) :: points
      !> Bands of the material
      type(crack_band_type), intent(inout) :: band

      integer :: k

      do k = 1, 2
         band%narrowest(k) = min(band%narrowest(k), length(k))
         call widen(length(k), place, k, band)
      end do
      band%points = band%points + points
      where (material%law%snaps_back(length))
         band%too_wide(:) = band%too_wide + points
      end where
   end subroutine add_band_points

   !> Note a band if it is the widest, or the first of the widest
   pure subroutine widen(width, place, k, band)
      !> Its width
      real(wp), intent(in) :: width
      !> Element, ply and group
      integer, intent(in) :: place(3)
      !> Fibres or matrix
      integer, intent(in) :: k
      !> Bands of the material
      type(crack_band_type), intent(inout) :: band

      if (width <= 0.0_wp .or. width < band%widest(k)) return
      if (width <= band%widest(k)) then
         if (place(1) > band%element(k)) return
         if (place(1) == band%element(k) .and. place(2) >= band%ply(k)) return
      end if
      band%widest(k) = width
      band%element(k) = place(1)
      band%ply(k) = place(2)
      band%group(k) = place(3)
   end subroutine widen

end module plydyn_element_crack_bands
