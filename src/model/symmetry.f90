!> Planes of symmetry: how many times the model makes up the plate that it stands for.
!>
!> A straight side of the mesh is such a plane if every impactor has its centre on it, and all its
!> points are held across it, but not along z: an impact on a clamped or a free edge has none.
module plydyn_model_symmetry
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text
   use plydyn_model_model, only : model_type
   use plydyn_model_support, only : all_planes
   implicit none
   private

   public :: copies, find_planes, part_name, plane_words, whole_name

   !> Ends of the mesh
   integer, parameter :: low_side = 1, high_side = 2
   !> Share of the size of the mesh within which places are the same
   real(wp), parameter :: near = 1.0e-6_wp

contains

   !> The sides across x and y that are planes: `low_side`, `high_side` or 0 for none
   pure function find_planes(model) result(planes)
      !> The model, with its impactors
      type(model_type), intent(in) :: model
      integer :: planes(2)

      planes(:) = [plane(model, 1), plane(model, 2)]
   end function find_planes

   !> 1 for a model of the whole plate, 2 for half of it, 4 for a quarter
   pure integer function copies(model)
      !> The model
      type(model_type), intent(in) :: model

      copies = 2**count(model%planes /= 0)
   end function copies

   !> What of the plate is modelled
   pure function part_name(model) result(name)
      !> The model
      type(model_type), intent(in) :: model
      character(:), allocatable :: name

      name = trim(merge("quarter", "half   ", copies(model) == 4))
   end function part_name

   !> What numbers of the whole plate are marked with; empty where the model is the whole
   pure function whole_name(model) result(name)
      !> The model
      type(model_type), intent(in) :: model
      character(:), allocatable :: name

      name = ""
      if (any(model%planes /= 0)) name = "whole plate, "//text(copies(model))//" x the " &
         & //part_name(model)
   end function whole_name

   !> The planes by their places, such as `x=0 y=0`
   pure function plane_words(model) result(words)
      !> The model
      type(model_type), intent(in) :: model
      character(:), allocatable :: words

      integer :: axis
      real(wp) :: place

      words = ""
      do axis = 1, 2
         if (model%planes(axis) == 0) cycle
         place = merge(minval(model%mesh%position(axis, :)), &
            & maxval(model%mesh%position(axis, :)), model%planes(axis) == low_side)
         words = words//" "//merge("x", "y", axis == 1)//"="//text(place)
      end do
      words = trim(adjustl(words))
   end function plane_words

   !> The side across an axis that is a plane of symmetry, 0 for none
   pure integer function plane(model, axis)
      type(model_type), intent(in) :: model
      !> 1 for x, 2 for y
      integer, intent(in) :: axis

      real(wp) :: centre, low, high, slack

      plane = 0
      if (size(model%impactors) == 0) return
      associate (place => model%mesh%position(axis, :))
         low = minval(place)
         high = maxval(place)
         slack = near*(high - low)
         centre = model%impactors(1)%centre(axis)
         if (any(abs(model%impactors%centre(axis) - centre) > slack)) return
         if (min(abs(centre - low), abs(high - centre)) > slack) return
         if (.not. is_symmetric(model, axis, abs(place - centre) <= slack)) return
         plane = merge(low_side, high_side, abs(centre - low) <= slack)
      end associate
   end function plane

   !> Whether the nodes of a straight side are held across it, and not all of them along z
   pure logical function is_symmetric(model, axis, on_side)
      type(model_type), intent(in) :: model
      integer, intent(in) :: axis
      !> Nodes of the side
      logical, intent(in) :: on_side(:)

      logical :: held(size(on_side), 3)
      integer :: i, k

      held(:, :) = .false.
      do i = 1, size(model%supports)
         associate (support => model%supports(i))
            if (support%face /= all_planes) cycle
            do k = 1, 3
               if (support%direction(k)) held(support%nodes, k) = .true.
            end do
         end associate
      end do
      associate (along => pack(model%mesh%position(3 - axis, :), on_side), &
         & size_of_mesh => maxval(model%mesh%position(3 - axis, :)) &
         & - minval(model%mesh%position(3 - axis, :)))
         is_symmetric = maxval(along) - minval(along) > near*size_of_mesh &
            & .and. all(held(:, axis) .or. .not. on_side) &
            & .and. any(on_side .and. .not. (held(:, 3) .or. held(:, 3 - axis)))
      end associate
   end function is_symmetric

end module plydyn_model_symmetry
