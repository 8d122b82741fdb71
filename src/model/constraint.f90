!> Linear constraints between displacements.
module plydyn_model_constraint
   use plydyn_base_precision, only : wp
   use plydyn_model_support, only : all_planes, prescribes_velocity
   implicit none
   private

   !> A displacement and its coefficient
   type, public :: constraint_term_type
      !> Index into `mesh%node_id`
      integer :: node = 0
      !> 1, 2, 3 for x, y, z
      integer :: direction = 0
      !> `bottom_face`, `top_face`, or `all_planes` for the mean over the thickness, by mass
      integer :: face = all_planes
      !> The coefficient
      real(wp) :: coefficient = 0.0_wp
   end type constraint_term_type

   !> The sum of displacements times coefficients is prescribed
   type, public :: constraint_type
      !> The user's number
      integer :: id = 0
      !> The sum
      type(constraint_term_type), allocatable :: terms(:)
      !> `prescribes_velocity` or `prescribes_displacement`
      integer :: quantity = prescribes_velocity
      !> Index into `model%curves`, 0 where the sum is zero
      integer :: curve = 0
      !> Factor on the curve
      real(wp) :: scale = 1.0_wp
   end type constraint_type

end module plydyn_model_constraint
