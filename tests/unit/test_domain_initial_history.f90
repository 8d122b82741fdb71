!> Histories of damaged plies begin with the widths that the mesh gives to their crack bands.
program test_domain_initial_history
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_crack_band_widths, only : check_bands
   use plydyn_domain_build, only : build_domain, start_histories
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_recover, only : point_history
   use plydyn_fem_quadrature, only : quad_points
   use plydyn_law_ply_crack_band, only : rule_band, rule_gauss_point, rule_root_point, &
      & rule_root_quad
   use plydyn_law_ply_constants, only : ply_constants_type, snap_reduce, snap_refuse
   use plydyn_law_ply_history, only : fibre_threshold, matrix_threshold
   use plydyn_model_material, only : add_material, material_type
   use plydyn_model_model, only : model_type
   use ply_point, only : paper_ply
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, check_error, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> Quads of 1.5 by 0.9, and a ply at 90 degrees below an elastic one and one at atan(3/4)
   real(wp), parameter :: size_x = 1.5_wp, size_y = 0.9_wp
   real(wp), parameter :: slanted = atan(0.75_wp)*180.0_wp/acos(-1.0_wp)
   !> Gauss weights of a line of three points
   real(wp), parameter :: outer = 5.0_wp/9.0_wp, middle = 8.0_wp/9.0_wp

   call test_rules()
   call test_width_given()
   call test_bands()
   call test_refused()
   call finish()

contains

   !> The four rules at the corner point and the middle point of a rectangle
   subroutine test_rules()
      real(wp), parameter :: share = 13.0_wp/18.0_wp
      !> Lines through the middle at the angle and across it leave by the sides y = const
      real(wp), parameter :: along = size_y/0.6_wp, across = size_y/0.8_wp

      call begin("rules")
      call check(widths(rule_band, 9, 1, 1), share*[size_y, size_x], 1.0e-12_wp, "of a side")
      call check(widths(rule_band, 9, 3, 1), share*[along, across], 1.0e-12_wp, "of a chord")
      call check(widths(rule_band, 4, 1, 1), [size_y, size_x], 1.0e-12_wp, "a whole quad of 4")
      call check(widths(rule_gauss_point, 9, 1, 1), 0.5_wp*outer*[size_y, size_x], 1.0e-12_wp, &
         & "Gauss point in a corner")
      call check(widths(rule_gauss_point, 9, 1, 4), 0.5_wp*[middle*size_y, outer*size_x], &
         & 1.0e-12_wp, "Gauss point beside the middle")
      call check(widths(rule_root_point, 9, 1, 4), spread(0.5_wp*sqrt(middle*outer*size_x*size_y), &
         & 1, 2), 1.0e-12_wp, "root of the area of a Gauss point")
      call check(widths(rule_root_quad, 9, 3, 5), spread(sqrt(size_x*size_y), 1, 2), 1.0e-12_wp, &
         & "root of the area of the quad")
      call check(widths(rule_band, 9, 2, 1), [0.0_wp, 0.0_wp], 0.0_wp, "elastic plies have none")
   end subroutine test_rules

   !> A width from the deck is taken as it is
   subroutine test_width_given()
      type(model_type) :: model

      call begin("given width")
      model = plate(rule_band, 9)
      call set_ply(model, 0.125_wp, snap_reduce)
      call check(widths_of(model, 3, 5), [0.125_wp, 0.125_wp], 0.0_wp, "wherever, along and across")
   end subroutine test_width_given

   !> Narrowest and widest bands, and counts of Gauss points
   subroutine test_bands()
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model

      call begin("find_bands")
      model = plate(rule_root_quad, 9)
      call build_domain(model, domain, error)
      associate (bands => domain%crack_bands)
         call check(bands(1)%points == 0, "none in elastic plies")
         call check([bands(2)%narrowest, bands(2)%widest], spread(sqrt(size_x*size_y), 1, 4), &
            & 1.0e-12_wp, "widths")
         ! 2 quads with 9 points in the plane; two plies of order 1 and 2
         call check(bands(2)%points == 2*9*(2 + 3), "points of all damaged plies")
         ! Table 5: 0.674, 0.407 and 0.326 are the widest bands of matrix cracks
         call check(all(bands(2)%too_wide == [0, 0, 90, 90, 90]), "too wide for the matrix")
      end associate
   end subroutine test_bands

   !> A mesh that is too coarse is refused on request, and the element named
   subroutine test_refused()
      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(model_type) :: model

      call begin("check_bands")
      model = plate(rule_band, 9)
      call set_ply(model, 0.0_wp, snap_refuse)
      call build_domain(model, domain, error)
      call check_error(error, "a.k:7: *MAT_PLY_CODAM2 SNAP: in quad 10", "place and quad")
      call check_error(error, "ply 1 from the bottom, the crack band of matrix tension is 1.08", &
         & "ply, mode and width")
      call set_ply(model, 0.3_wp, snap_refuse)
      call check_bands(model, domain, error)
      call check(allocated(error), "the domain counts: its laws have the old width")
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "takes a band that is narrow enough")
   end subroutine test_refused

   !> Widths at a Gauss point of the first quad, for fibres and matrix
   function widths(rule, nodes, layer, point)
      integer, intent(in) :: rule, nodes, layer, point
      real(wp) :: widths(2)

      widths(:) = widths_of(plate(rule, nodes), layer, point)
   end function widths

   !> Widths in the history of a Gauss point, alike at all heights
   function widths_of(model, layer, point) result(widths)
      type(model_type), intent(in) :: model
      integer, intent(in) :: layer, point
      real(wp) :: widths(2)

      type(domain_type) :: domain
      type(error_type), allocatable :: error
      type(plate_type) :: own
      real(wp), allocatable :: history(:), values(:, :)

      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
      allocate (history(domain%histories))
      history(:) = 0.0_wp
      call start_histories(model, domain, history)
      own = plate_of(domain, 1)
      associate (slot => domain%columns%layer_slot(:, layer))
         values = point_history(own, own%batches(slot(1)), slot(2), 1, point, 2, history)
         widths(:) = values(slot(3), [fibre_threshold, matrix_threshold])
      end associate
   end function widths_of

   !> Width of the crack bands of the damaged plies, and what to do about snap-back
   subroutine set_ply(model, band_width, snap_back)
      type(model_type), intent(inout) :: model
      real(wp), intent(in) :: band_width
      integer, intent(in) :: snap_back

      select type (ply => model%materials(2)%law)
      type is (ply_constants_type)
         ply%band_width = band_width
         ply%snap_back = snap_back
      end select
   end subroutine set_ply

   !> Two quads with an elastic ply between damaged ones
   function plate(rule, nodes) result(model)
      integer, intent(in) :: rule, nodes
      type(model_type) :: model
      type(material_type) :: material
      type(ply_constants_type) :: ply

      model = rectangle_model(rectangle_mesh(nint(sqrt(real(nodes, wp))), 2, 1, 2.0_wp*size_x, &
         & size_y, 0.0_wp), [90.0_wp, 0.0_wp, slanted], 0.25_wp, [1, 1, 2])
      material%id = 2
      material%keyword = "MAT_PLY_CODAM2"
      material%place = "a.k:7"
      material%title = "damaged"
      material%density = model%materials(1)%density
      ply = paper_ply()
      ply%band_rule = rule
      call add_material(model%materials, material, ply)
      model%parts(1)%plies%material = [2, 1, 2]
   end function plate

end program test_domain_initial_history
