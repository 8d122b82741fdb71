!> The least ratio of volumes of all elements of the model.
module plydyn_domain_least_volume
   use plydyn_base_precision, only : wp
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_least_volume, only : least_volume_type
   implicit none
   private

   public :: find_least_volume

contains

   !> The least ratio of volumes, det F, of all ranks; the same on all of them, which come together
   function find_least_volume(domain, displacement) result(least)
      type(domain_type), intent(in) :: domain
      !> Displacement of all points
      real(wp), intent(in), contiguous :: displacement(:)
      type(least_volume_type) :: least

      type(least_volume_type) :: own
      integer :: g

      do g = 1, size(domain%groups)
         own = least_volume_type()
         call domain%groups(g)%item%find_volume(displacement, own)
         own%group = g
         if (is_less(own, least)) least = own
      end do
      if (domain%comm%ranks > 1) call take_least(domain, least)
   end function find_least_volume

   !> Whether one comes before another
   pure logical function is_less(a, b)
      type(least_volume_type), intent(in) :: a, b

      is_less = a%ratio < b%ratio .or. (a%ratio <= b%ratio .and. a%element < b%element)
   end function is_less

   !> The least of all ranks: the least is the greatest below zero
   subroutine take_least(domain, least)
      type(domain_type), intent(in) :: domain
      type(least_volume_type), intent(inout) :: least

      type(least_volume_type) :: own
      real(wp) :: greatest(1), place(2)

      own = least
      greatest(1) = -own%ratio
      call domain%comm%max(greatest)
      least%ratio = -greatest(1)
      greatest(1) = -huge(1.0_wp)
      if (own%ratio <= least%ratio) greatest(1) = -real(own%element, wp)
      call domain%comm%max(greatest)
      least%element = nint(-greatest(1))
      place(:) = 0.0_wp
      if (own%ratio <= least%ratio .and. own%element == least%element) then
         place(:) = [own%layer, own%group]
      end if
      call domain%comm%max(place)
      least%layer = nint(place(1))
      least%group = nint(place(2))
   end subroutine take_least

end module plydyn_domain_least_volume
