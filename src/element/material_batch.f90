!> Materials of lanes side by side, the layers of plates or bricks, and the strain and stress that
!> are recovered at their Gauss points.
module plydyn_element_material_batch
   use plydyn_base_precision, only : lanes, wp
   use plydyn_element_group, only : ply_strain_at, ply_stress_at, scalars_at, strain_at, stress_at
   use plydyn_fem_kinematics, only : find_cauchy, turn_strain, turn_stress, turn_stress_back, &
      & volume_ratios
   use plydyn_law_compression_barrier, only : barrier_stress
   use plydyn_law_law, only : block_law_type
   use plydyn_law_ply_elastic, only : turned_stiffness
   use plydyn_model_material, only : material_type
   implicit none
   private

   public :: batch_stiffness, elastic_stress, new_laws, new_material_batch, point_values

   !> Materials of blocks of as many layers as there are lanes; bricks have one block, and count as
   !> layers of half thickness 1
   type, public :: material_batch_type
      !> Stiffness in the axes of the plate times half the thickness, (lanes, 13, blocks):
      !> C11 C12 C13 C14 C22 C23 C24 C33 C34 C44 C55 C56 C66; zero in lanes without a layer
      real(wp), allocatable :: stiffness(:, :, :)
      !> Half the thickness, and 2 over the thickness, (lanes, blocks)
      real(wp), allocatable :: half_thickness(:, :), two_over_h(:, :)
      !> Cosine and sine of the fibre direction, (lanes, 2, blocks)
      real(wp), allocatable :: rotation(:, :, :)
      !> Laws of the lanes; none where all are elastic
      type(block_law_type), allocatable :: laws(:)
      !> History variables of a Gauss point, and where those of this batch begin in the state
      integer :: histories = 0, first_history = 0
   end type material_batch_type

   !> Place of C33 among the constants of a stiffness
   integer, parameter, public :: c33 = 8
   !> The constants of a monoclinic stiffness that kernels use, by row and column
   integer, parameter :: row(13) = [1, 1, 1, 1, 2, 2, 2, 3, 3, 4, 5, 5, 6]
   integer, parameter :: column(13) = [1, 2, 3, 4, 2, 3, 4, 3, 4, 4, 5, 6, 6]

contains

   !> Materials of the lanes of some blocks
   function new_material_batch(materials, material, half_thickness, angle) result(self)
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      !> Material of each lane, 0 where there is no layer, (lanes, blocks)
      integer, intent(in) :: material(:, :)
      !> Half the thickness; fibre direction, degrees from the x axis
      real(wp), intent(in), dimension(lanes, size(material, 2)) :: half_thickness, angle
      type(material_batch_type) :: self

      real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
      integer :: b, blocks, k, l

      blocks = size(material, 2)
      allocate (self%stiffness(lanes, 13, blocks), self%rotation(lanes, 2, blocks), source=0.0_wp)
      allocate (self%half_thickness(lanes, blocks), self%two_over_h(lanes, blocks), source=0.0_wp)
      do b = 1, blocks
         do l = 1, lanes
            if (material(l, b) == 0) cycle
            self%half_thickness(l, b) = half_thickness(l, b)
            self%two_over_h(l, b) = 1.0_wp/half_thickness(l, b)
            self%rotation(l, :, b) = [cos(angle(l, b)*degree), sin(angle(l, b)*degree)]
            self%stiffness(l, :, b) = half_thickness(l, b)*batch_stiffness( &
               & turned_stiffness(materials(material(l, b))%law, angle(l, b)))
         end do
      end do
      self%laws = new_laws(materials, material)
      do k = 1, size(self%laws)
         self%histories = max(self%histories, self%laws(k)%law%histories)
      end do
   end function new_material_batch

   !> The constants of a stiffness in the order that kernels use
   pure function batch_stiffness(stiffness) result(constants)
      !> Stiffness in the axes of the plate; a plane of symmetry across z
      real(wp), intent(in) :: stiffness(6, 6)
      real(wp) :: constants(13)
      integer :: i

      constants(:) = [(stiffness(row(i), column(i)), i=1, 13)]
   end function batch_stiffness

   !> Laws of a batch of layers; none if all its materials are elastic
   function new_laws(materials, lane_material) result(laws)
      !> Materials of the model
      type(material_type), intent(in) :: materials(:)
      !> Material of each lane, 0 where there is no layer, (lanes, blocks)
      integer, intent(in) :: lane_material(:, :)
      type(block_law_type), allocatable :: laws(:)

      integer :: b, k, l, law_of(lanes, size(lane_material, 2))

      law_of(:, :) = number_laws(materials, lane_material)
      allocate (laws(maxval(law_of)))
      do b = 1, size(lane_material, 2)
         do l = 1, lanes
            k = law_of(l, b)
            if (k == 0) cycle
            associate (constants => materials(lane_material(l, b))%law)
               if (.not. allocated(laws(k)%law)) then
                  laws(k)%block = b
                  call constants%new_batch(laws(k)%law)
               end if
               call constants%set_lane(l, laws(k)%law)
            end associate
         end do
      end do
   end function new_laws

   !> Number of the law of each lane: lanes of a block share one where their materials can; 0 in
   !> lanes without a layer, and everywhere if all materials are elastic
   pure function number_laws(materials, lane_material) result(law_of)
      type(material_type), intent(in) :: materials(:)
      integer, intent(in) :: lane_material(:, :)
      integer :: law_of(lanes, size(lane_material, 2))

      integer :: b, k, l, laws
      logical :: elastic

      elastic = .true.
      laws = 0
      law_of(:, :) = 0
      do b = 1, size(lane_material, 2)
         do l = 1, lanes
            if (lane_material(l, b) == 0) cycle
            associate (law => materials(lane_material(l, b))%law)
               elastic = elastic .and. law%is_elastic()
               do k = 1, l - 1
                  if (lane_material(k, b) == 0) cycle
                  if (.not. law%shares_batch(materials(lane_material(k, b))%law)) cycle
                  law_of(l, b) = law_of(k, b)
                  exit
               end do
            end associate
            if (law_of(l, b) > 0) cycle
            laws = laws + 1
            law_of(l, b) = laws
         end do
      end do
      if (elastic) law_of(:, :) = 0
   end function number_laws

   !> Stress of elastic layers times half of their thickness
   pure subroutine elastic_stress(k, e, s)
      !> Stiffness times half the thickness, of a block of `material_batch_type`
      real(wp), intent(in) :: k(lanes, 13)
      !> Strain in the axes of the plate
      real(wp), intent(in) :: e(lanes, 6)
      !> Stress there times half the thickness
      real(wp), intent(out) :: s(lanes, 6)

      integer :: l

      !$omp simd
      do l = 1, lanes
         s(l, 1) = k(l, 1)*e(l, 1) + k(l, 2)*e(l, 2) + k(l, 3)*e(l, 3) + k(l, 4)*e(l, 4)
         s(l, 2) = k(l, 2)*e(l, 1) + k(l, 5)*e(l, 2) + k(l, 6)*e(l, 3) + k(l, 7)*e(l, 4)
         s(l, 3) = k(l, 3)*e(l, 1) + k(l, 6)*e(l, 2) + k(l, 8)*e(l, 3) + k(l, 9)*e(l, 4)
         s(l, 4) = k(l, 4)*e(l, 1) + k(l, 7)*e(l, 2) + k(l, 9)*e(l, 3) + k(l, 10)*e(l, 4)
         s(l, 5) = k(l, 11)*e(l, 5) + k(l, 12)*e(l, 6)
         s(l, 6) = k(l, 12)*e(l, 5) + k(l, 13)*e(l, 6)
      end do
   end subroutine elastic_stress

   !> Strain and stress of a block at a Gauss point, from the displacement gradients there. With
   !> large displacement strain is Green-Lagrange; stress is Cauchy in the axes of the plate and
   !> second Piola-Kirchhoff in those of the ply, which turn with the material
   pure function point_values(batch, block, large, h, strain, history) result(values)
      !> The batch, and block in it
      class(material_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      !> Large displacement
      logical, intent(in) :: large
      !> Displacement gradients, and their strain; history of the point
      real(wp), intent(in) :: h(lanes, 3, 3), strain(lanes, 6), history(:, :)
      !> (lanes, values)
      real(wp) :: values(lanes, scalars_at)

      real(wp) :: stress(lanes, 6), turned(lanes, 6)

      associate (rotation => batch%rotation(:, :, block))
         turned(:, :) = strain
         call turn_strain(rotation, turned)
         values(:, strain_at + 1:stress_at) = strain
         values(:, ply_strain_at + 1:ply_stress_at) = turned
         if (size(batch%laws) > 0) then
            stress(:, :) = law_stress(batch, block, turned, history)
            call turn_stress_back(rotation, stress)
         else
            call elastic_stress(batch%stiffness(:, :, block), strain, stress)
            stress(:, :) = stress*spread(batch%two_over_h(:, block), 2, 6)
         end if
         turned(:, :) = stress
         call turn_stress(rotation, turned)
         values(:, ply_stress_at + 1:scalars_at) = turned
         if (large) then
            call find_cauchy(h, stress)
            stress(:, :3) = stress(:, :3) + spread(barrier_stress(batch%two_over_h(:, block) &
               & *batch%stiffness(:, c33, block), volume_ratios(h)), 2, 3)
         end if
         values(:, stress_at + 1:ply_strain_at) = stress
      end associate
   end function point_values

   !> Stress of the laws of a block in ply axes
   pure function law_stress(batch, block, strain, history) result(stress)
      class(material_batch_type), intent(in) :: batch
      integer, intent(in) :: block
      real(wp), intent(in) :: strain(lanes, 6), history(:, :)
      real(wp) :: stress(lanes, 6)

      integer :: k

      stress(:, :) = 0.0_wp
      do k = 1, size(batch%laws)
         if (batch%laws(k)%block /= block) cycle
         call batch%laws(k)%law%stress_at(strain, history, stress)
      end do
   end function law_stress

end module plydyn_element_material_batch
