!> Laws of the layers, batch by batch.
module plydyn_domain_laws
   use plydyn_base_precision, only : lanes, wp
   use plydyn_law_law, only : block_law_type, law_type
   use plydyn_law_orthotropic, only : orthotropic_type
   use plydyn_law_plastic_kinematic, only : plastic_kinematic_type
   use plydyn_model_material, only : law_elastic, law_plastic_kinematic, material_type
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

      integer :: b, k

      allocate (laws(count_laws(materials, lane_material)))
      if (size(laws) == 0) return
      k = 0
      do b = 1, size(lane_material, 2)
         call add_law(laws, k, b, elastic_lanes(materials, lane_material(:, b)))
         call add_law(laws, k, b, plastic_lanes(materials, lane_material(:, b)))
      end do
   end function new_laws

   !> How many laws the blocks of a batch have; none if all its materials are elastic
   pure integer function count_laws(materials, lane_material) result(laws)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:, :)

      integer :: b, law
      logical :: used(law_elastic:law_plastic_kinematic)

      laws = 0
      used(:) = .false.
      do b = 1, size(lane_material, 2)
         associate (present => pack(lane_material(:, b), lane_material(:, b) > 0))
            used(:) = [(any(materials(present)%law == law), law=law_elastic, law_plastic_kinematic)]
         end associate
         laws = laws + count(used)
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
   function plastic_lanes(materials, lane_material) result(law)
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
   end function plastic_lanes

end module plydyn_domain_laws
