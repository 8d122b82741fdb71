!> The parts of the listing on how long a run lasts: beside the contact of impactors, and, where it
!> is loaded along the plane, beside the waves and periods of the plate.
module plydyn_io_listing_duration
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : fixed_text, padded, text
   use plydyn_domain_contact_duration, only : contact_duration_type, estimate_contact
   use plydyn_domain_domain, only : domain_type
   use plydyn_domain_loading_rate, only : find_loading_rate, loading_rate_type
   use plydyn_io_listing_table, only : write_section
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: contact_duration_warning, loading_rate_warning, write_contact_duration, &
      & write_loading_rate

   !> Parts of a whole
   real(wp), parameter :: per_cent = 100.0_wp
   !> Strain behind the front of a wave up to which a test may be slow: composites break at some ten
   !> times as much
   real(wp), parameter :: largest_front = 1.0e-3_wp

contains

   !> A warning where the run ends before the contact, else empty
   function contact_duration_warning(model) result(words)
      type(model_type), intent(in) :: model
      character(:), allocatable :: words

      type(contact_duration_type) :: found
      character(:), allocatable :: unit
      real(wp) :: end
      integer :: k

      words = ""
      unit = " "//trim(model%control%units%time)
      do k = 1, size(model%contacts)
         call estimate_contact(model, model%contacts(k), found)
         if (.not. found%is_known) cycle
         end = found%start + found%duration
         if (model%control%end_time >= end) cycle
         words = "warning: impactor "//text(model%impactors(model%contacts(k)%impactor)%id) &
            & //" will touch the plate for about "//text(found%duration, 2)//unit//" from " &
            & //text(found%start, 2)//unit//" on, longer than the run lasts; right would be " &
            & //"ENDTIM of *CONTROL_TERMINATION above "//text(end, 2)//unit//", and " &
            & //"*CONTROL_END_OF_CONTACT for an end after the contact"
         return
      end do
   end function contact_duration_warning

   !> The estimate for one contact
   subroutine write_contact_duration(unit, model, k)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      !> Index of the contact
      integer, intent(in) :: k

      type(contact_duration_type) :: found
      character(:), allocatable :: sides

      call estimate_contact(model, model%contacts(k), found)
      if (.not. found%is_known) return
      associate (units => model%control%units, span => found%span)
         if (minval(span) > 0.0_wp) then
            sides = "plate of "//fixed_text(span(1), 1)//" x "//fixed_text(span(2), 1)
         else
            sides = "beam of "//fixed_text(maxval(span), 1)
         end if
         write (unit, "(a,es14.7,6a)") padded("   duration, about", 29), found%duration, " ", &
            & trim(units%time), ", half a period on a simply supported ", sides, " ", &
            & trim(units%length)
      end associate
   end subroutine write_contact_duration

   !> A warning where the kinetic energy to be expected is more than the deck allows, or without
   !> such a limit where the front of a wave strains the plate much, else empty
   function loading_rate_warning(model, domain) result(words)
      type(model_type), intent(in) :: model
      !> The domain, of any rank
      type(domain_type), intent(in) :: domain
      character(:), allocatable :: words

      type(loading_rate_type) :: rate
      real(wp) :: least

      words = ""
      if (domain%control%kinetic_limit <= 0.0_wp .and. size(model%motions) == 0) return
      call find_loading_rate(model, mass_ratio(domain), rate)
      if (domain%control%kinetic_limit <= 0.0_wp) then
         if (rate%motion > 0) words = front_warning(model, rate)
         return
      end if
      if (rate%kinetic_share <= domain%control%kinetic_limit) return
      ! the share falls with the square of the time
      least = rate%loading_time*sqrt(rate%kinetic_share/domain%control%kinetic_limit)
      words = "warning: "//trim(model%motions(rate%motion)%name)//" moves within " &
         & //fixed_text(rate%loading_time/rate%wave_time, 1)//" passages of a wave along the " &
         & //"plate: after a tenth of the time the kinetic energy is then about " &
         & //fixed_text(per_cent*rate%kinetic_share, 1)//" % of the internal one, more than " &
         & //"SHARE of *CONTROL_QUASI_STATIC; right would be the same curve over "//text(least, 2) &
         & //" "//trim(model%control%units%time)//", "//fixed_text(least/rate%wave_time, 0) &
         & //" passages, at least"
   end function loading_rate_warning

   !> A warning where the front of the wave from the points that move strains the plate much
   function front_warning(model, rate) result(words)
      type(model_type), intent(in) :: model
      !> Has a motion
      type(loading_rate_type), intent(in) :: rate
      character(:), allocatable :: words

      character(:), allocatable :: unit

      words = ""
      if (rate%speed <= largest_front*rate%wave_speed) return
      unit = " "//model%control%units%velocity()
      words = "warning: "//trim(model%motions(rate%motion)%name)//" moves at up to " &
         & //text(rate%speed, 4)//unit//": the front of its wave alone strains the plate by " &
         & //text(per_cent*rate%speed/rate%wave_speed, 3)//" %; right would be, for a test that " &
         & //"is slow, "//text(largest_front*rate%wave_speed, 2)//unit//" at most, and " &
         & //"*CONTROL_QUASI_STATIC to check it"
   end function front_warning

   !> Waves and periods within the time of loading, where a quasi-static deck moves points along x
   !> or y
   subroutine write_loading_rate(unit, model, domain)
      !> Unit of the listing
      integer, intent(in) :: unit
      type(model_type), intent(in) :: model
      !> The domain, of any rank
      type(domain_type), intent(in) :: domain

      type(loading_rate_type) :: rate
      character(:), allocatable :: time

      if (max(domain%control%kinetic_limit, domain%control%load_share) <= 0.0_wp) return
      call find_loading_rate(model, mass_ratio(domain), rate)
      if (rate%motion == 0) return
      call write_section(unit, "Loading rate")
      associate (u => model%control%units, motion => model%motions(rate%motion))
         time = " "//trim(u%time)
         write (unit, "(4a)") "fastest motion                along ", &
            & achar(iachar("x") + motion%direction - 1), ", ", trim(motion%name)
         write (unit, "(a,es12.5,4a)") "largest speed                ", rate%speed, " ", &
            & trim(u%length), "/", trim(u%time)
         write (unit, "(a,es12.5,1x,a)") "stress behind a wave of it   ", rate%wave_stress, &
            & trim(u%stress)
         write (unit, "(a,es12.5,1x,a)") "length of the plate          ", rate%length, &
            & trim(u%length)
         write (unit, "(a,es12.5,4a)") "speed of a wave along it     ", rate%wave_speed, " ", &
            & trim(u%length), "/", trim(u%time)
         write (unit, "(a,es12.5,a)") "time of a wave along it      ", rate%wave_time, time
         write (unit, "(a,es12.5,4a)") "loading time                 ", rate%loading_time, time, &
            & ", ", fixed_text(rate%loading_time/rate%wave_time, 1), " passages of a wave"
         if (rate%period > 0.0_wp) then
            write (unit, "(a,es12.5,5a)") "first period, about          ", rate%period, time, &
               & " with simply supported edges, ", &
               & fixed_text(rate%loading_time/rate%period, 1), " in the loading time"
         end if
         write (unit, "(a,es12.5,a)") "kinetic over internal energy ", rate%kinetic_share, &
            & " at most, to be expected after a tenth of the time"
      end associate
   end subroutine write_loading_rate

   !> Mass with added mass over that without
   pure real(wp) function mass_ratio(domain)
      type(domain_type), intent(in) :: domain

      mass_ratio = 1.0_wp
      if (size(domain%inertia%added) == 0) return
      mass_ratio = 1.0_wp + sum(domain%inertia%added%added)/sum(domain%inertia%added%own)
   end function mass_ratio

end module plydyn_io_listing_duration
