!> Laws of the layers, batch by batch.
module plydyn_domain_laws
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_ply_crack_band, only : rule_band
   use plydyn_law_law, only : block_law_type, law_type
   use plydyn_law_ply_orthotropic, only : orthotropic_type
   use plydyn_law_metal_tabulated, only : plastic_curve_type
   use plydyn_law_metal_johnson_cook, only : plastic_johnson_cook_type
   use plydyn_law_metal_kinematic, only : plastic_kinematic_type
   use plydyn_law_ply_damage, only : ply_damage_type
   use plydyn_law_ply_strain_damage, only : strain_damage_type
   use plydyn_law_metal_yield_curve, only : yield_curve_type
   use plydyn_model_material, only : last_law, law_elastic, law_plastic_curve, &
      & law_plastic_johnson_cook, law_plastic_kinematic, law_ply_damage, &
      & law_strain_damage, material_type, plasticity_type
   implicit none
   private

   public :: new_laws

contains

   !> Laws of a batch of layers; none if all its materials are elastic
   function new_laws(materials, lane_material) result(laws)
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      !> Material of each lane, 0 where there is no layer, (lanes, blocks)
      integer, intent(in) :: lane_material(:, :)
      type(block_law_type), allocatable :: laws(:)

      integer :: b, i, k

      allocate (laws(count_laws(materials, lane_material)))
      if (size(laws) == 0) return
      k = 0
      do b = 1, size(lane_material, 2)
         call add_law(laws, k, b, elastic_lanes(materials, lane_material(:, b)))
         call add_law(laws, k, b, kinematic_lanes(materials, lane_material(:, b)))
         call add_law(laws, k, b, curve_lanes(materials, lane_material(:, b)))
         call add_law(laws, k, b, johnson_cook_lanes(materials, lane_material(:, b)))
         ! lanes whose strains are averaged over neighbours have a law of their own
         do i = 1, 2
            call add_law(laws, k, b, damage_lanes(materials, lane_material(:, b), i == 2))
            call add_law(laws, k, b, strain_lanes(materials, lane_material(:, b), i == 2))
         end do
      end do
   end function new_laws

   !> How many laws the blocks of a batch have; none if all its materials are elastic
   pure integer function count_laws(materials, lane_material) result(laws)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:, :)

      integer :: b, law

      laws = 0
      do b = 1, size(lane_material, 2)
         associate (present => materials(pack(lane_material(:, b), lane_material(:, b) > 0)))
            do law = law_elastic, last_law
               laws = laws + count([any(present%law == law .and. .not. present%averages()), &
                  & any(present%law == law .and. present%averages())])
            end do
         end associate
      end do
      if (all(materials(pack(lane_material, lane_material > 0))%law == law_elastic)) laws = 0
   end function count_laws

   !> Add a law to a block, if any lane has it
   subroutine add_law(laws, k, block, law)
      type(block_law_type), intent(inout) :: laws(:)
      !> Laws so far
      integer, intent(inout) :: k
      integer, intent(in) :: block
      class(law_type), intent(in) :: law

      if (.not. any(law%owns)) return
      k = k + 1
      laws(k)%block = block
      allocate (laws(k)%law, source=law)
   end subroutine add_law

   !> The lanes of a block that stay elastic
   function elastic_lanes(materials, lane_material) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      type(orthotropic_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_elastic) cycle
            call law%set_lane(l, material%young, material%poisson, material%shear)
         end associate
      end do
   end function elastic_lanes

   !> The lanes of a block that yield with linear hardening
   function kinematic_lanes(materials, lane_material) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      type(plastic_kinematic_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_plastic_kinematic) cycle
            associate (plasticity => material%plasticity)
               call law%set_lane(l, material%young(1), material%poisson(1), plasticity%yield, &
                  & plasticity%tangent, plasticity%isotropic)
               if (plasticity%rate > 0.0_wp) call law%set_rate(l, plasticity%rate, plasticity%power)
            end associate
         end associate
      end do
   end function kinematic_lanes

   !> The lanes of a block that yield by curves
   function curve_lanes(materials, lane_material) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      type(plastic_curve_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_plastic_curve) cycle
            associate (plasticity => material%plasticity)
               call law%set_lane(l, material%young(1), material%poisson(1), &
                  & yield_curves(plasticity), plasticity%logarithmic)
               if (plasticity%rate > 0.0_wp) then
                  call law%set_rate(l, plasticity%rate, plasticity%power, basis=plasticity%yield)
               end if
            end associate
         end associate
      end do
   end function curve_lanes

   !> Yield stress over effective plastic strain at some rates
   pure function yield_curves(plasticity) result(curves)
      type(plasticity_type), intent(in) :: plasticity
      type(yield_curve_type) :: curves(size(plasticity%curves))

      integer :: i

      do i = 1, size(curves)
         curves(i)%rate = plasticity%rates(i)
         curves(i)%strain = plasticity%curves(i)%x
         curves(i)%stress = plasticity%curves(i)%y
      end do
   end function yield_curves

   !> The lanes of a block that yield after Johnson and Cook
   function johnson_cook_lanes(materials, lane_material) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      type(plastic_johnson_cook_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_plastic_johnson_cook) cycle
            associate (plasticity => material%plasticity)
               call law%set_lane(l, material%young(1), material%poisson(1), plasticity%yield, &
                  & plasticity%factor, plasticity%exponent)
               call law%set_rate(l, plasticity%sensitivity, plasticity%reference_rate)
            end associate
         end associate
      end do
   end function johnson_cook_lanes

   !> The lanes of a block whose fibres and matrix are damaged
   function damage_lanes(materials, lane_material, averages) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      !> Those whose strains are averaged, else the others
      logical, intent(in) :: averages
      type(ply_damage_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_ply_damage .or. (material%averages() .neqv. averages)) cycle
            call law%set_lane(l, material%ply)
            if (averages) call law%set_average(l, material%radius)
         end associate
      end do
   end function damage_lanes

   !> The lanes of a block whose damage begins and ends at strains of the deck
   function strain_lanes(materials, lane_material, averages) result(law)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:)
      !> Those whose strains are averaged, else the others
      logical, intent(in) :: averages
      type(strain_damage_type) :: law
      integer :: l

      do l = 1, lanes
         if (lane_material(l) == 0) cycle
         associate (material => materials(lane_material(l)))
            if (material%law /= law_strain_damage .or. (material%averages() .neqv. averages)) cycle
            call law%set_lane(l, material%strains, rule_band)
            if (averages) call law%set_average(l, material%radius)
         end associate
      end do
   end function strain_lanes

end module plydyn_domain_laws
