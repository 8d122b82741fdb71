!> Damage that falls at once, or while something else begins: what it costs, and what it must not
!> disturb.
program test_law_ply_damage_jumps
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_elastic, only : ply_stiffness
   use plydyn_law_law, only : scalars, shows_matrix_damage, shows_shear_damage
   use plydyn_law_ply_constants, only : ply_constants_type, snap_drop
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_history, only : fibre_energy, histories_open, matrix_damage, matrix_onset
   use ply_point, only : new_point, paper_ply, point_type
   use testing, only : begin, check, finish
   implicit none

   !> Crack bands narrow enough for every mode, with room
   real(wp), parameter :: narrow(2) = [1.0_wp, 0.1_wp]

   call test_drop()
   call test_neighbour_begins()
   call test_closing_costs_its_mean()
   call test_largest_damage()
   call finish()

contains

   !> Strain across alone, with lateral strain held: the stress drops at a strain, and all that was
   !> stored is free
   subroutine test_drop()
      integer, parameter :: steps = 20000
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: c(6, 6), onset, strain(6)
      integer :: i

      call begin("drop with lateral strain held")
      ply = paper_ply()
      ply%snap_back = snap_drop
      ply%matrix_toughness(:) = 1.0e-3_wp
      ply%residual = 1.0e-9_wp
      c(:, :) = ply_stiffness(ply%young, ply%poisson, ply%shear)
      onset = ply%matrix_strength(1)/c(2, 2)
      point = new_point(ply, narrow)
      strain(:) = 0.0_wp
      do i = 1, steps
         strain(2) = 1.2_wp*onset*real(i, wp)/real(steps, wp)
         call point%move(strain)
      end do
      call check(point%history(matrix_damage), 1.0_wp, 0.0_wp, "breaks")
      ! the strain of onset is met within a step
      call check(point%dissipated()/(0.5_wp*c(2, 2)*onset**2), 1.0_wp, 4.0_wp/real(steps, wp), &
         & "sets free what was stored")
      call check(point%work - point%stored(), point%dissipated(), &
         & 4.0_wp/real(steps, wp)*point%work, "which is the work")
   end subroutine test_drop

   !> Fibres of one ply soften while Poisson's effect cracks the matrix of another one beside it
   subroutine test_neighbour_begins()
      integer, parameter :: steps = 200
      type(ply_damage_type) :: alone, both
      type(ply_constants_type) :: soft, tough
      real(wp) :: apart(lanes, histories_open), strain(lanes, 6), stress(lanes, 6, 2)
      real(wp) :: together(lanes, histories_open)
      integer :: i, l
      logical :: differs

      call begin("a ply beside one that begins")
      soft = paper_ply()
      soft%matrix_strength(:) = 5000.0_wp
      soft%matrix_toughness(:) = 500.0_wp
      tough = paper_ply()
      tough%fibre_strength(:) = 20000.0_wp
      tough%fibre_toughness(:) = 2000.0_wp
      tough%matrix_strength(1) = 110.0_wp
      tough%matrix_toughness(:) = 50.0_wp
      do l = 1, lanes
         call alone%set_lane(l, soft)
         call both%set_lane(l, merge_ply(soft, tough, mod(l, 2) == 1))
      end do
      call start(alone, apart)
      call start(both, together)
      differs = .false.
      do i = 1, steps
         strain(:, :) = 0.0_wp
         strain(:, 1) = 0.06_wp*real(i, wp)/real(steps, wp)
         call alone%update(0.0_wp, strain, apart, stress(:, :, 1))
         call both%update(0.0_wp, strain, together, stress(:, :, 2))
         differs = differs .or. any(abs(stress(1, :, 1) - stress(1, :, 2)) > 0.0_wp)
      end do
      call check(together(2, matrix_onset) > 0.0_wp .and. apart(1, fibre_energy) > 0.0_wp, &
         & "both are damaged")
      call check(.not. differs, "has the stress that it has alone")
      call check(together(1, fibre_energy), apart(1, fibre_energy), 0.0_wp, "and its energy")
   end subroutine test_neighbour_begins

   !> One of two plies
   pure function merge_ply(one, other, first) result(ply)
      type(ply_constants_type), intent(in) :: one, other
      logical, intent(in) :: first
      type(ply_constants_type) :: ply

      ply = other
      if (first) ply = one
   end function merge_ply

   !> History of a point at rest
   subroutine start(law, history)
      type(ply_damage_type), intent(in) :: law
      real(wp), intent(out) :: history(lanes, histories_open)

      history(:, :) = 0.0_wp
      call law%start_history(spread(narrow, 1, lanes), spread(maxval(narrow), 1, lanes), history)
   end subroutine start

   !> Without Poisson's effect a crack that could close costs what one costs that cannot: its
   !> toughness, by steps that are not small
   subroutine test_closing_costs_its_mean()
      integer, parameter :: steps = 400
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: last
      integer :: i, sense

      call begin("cracks that can close")
      ply = paper_ply()
      ply%poisson(:) = 0.0_wp
      ply%closes = .true.
      ply%residual = 1.0e-9_wp
      do sense = 1, 2
         point = new_point(ply, narrow)
         associate (toughness => ply%matrix_toughness(sense), &
            & strength => ply%matrix_strength(sense), sign => real(3 - 2*sense, wp))
            last = 1.01_wp*2.0_wp*toughness/(narrow(2)*strength)
            do i = 1, steps
               call point%pull(2, sign*last*real(i, wp)/real(steps, wp), 0.0_wp)
            end do
            call check(point%dissipated()*narrow(2)/toughness, 1.0_wp, 1.0e-6_wp, &
               & "dissipate their toughness")
         end associate
      end do
   end subroutine test_closing_costs_its_mean

   !> Fields show no more damage than acts
   subroutine test_largest_damage()
      type(point_type) :: point
      type(ply_constants_type) :: ply
      real(wp) :: values(scalars)

      call begin("largest damage")
      ply = paper_ply()
      ply%residual = 0.3_wp
      ply%poisson(:) = 0.0_wp
      point = new_point(ply, narrow)
      call point%pull(2, 0.2_wp, 0.0_wp)
      values(:) = point%law%output_variables(1, spread(point%history, 1, lanes))
      call check(point%stress(2)/(0.3_wp*10.3e3_wp*0.2_wp), 1.0_wp, 1.0e-12_wp, "leaves its part")
      call check(values([shows_matrix_damage, shows_shear_damage]), [0.7_wp, 0.7_wp], 1.0e-15_wp, &
         & "is what is shown")
   end subroutine test_largest_damage

end program test_law_ply_damage_jumps
