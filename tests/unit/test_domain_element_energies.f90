!> Layers that yield, through domain and forces: stress, history, what is dissipated and recovered.
program test_domain_element_energies
   use plydyn_base_error, only : error_type
   use plydyn_base_precision, only : wp
   use plydyn_domain_build, only : build_domain
   use plydyn_domain_delamination, only : delamination_type
   use plydyn_domain_element_energies, only : dissipated_energies, stored_energies
   use plydyn_domain_domain, only : domain_type
   use plydyn_element_plate_recover, only : layer_values
   use plydyn_element_group, only : recovered, scalars_at, stress_at
   use plydyn_law_law, only : by_metal_plasticity, mechanisms, shows_plastic_strain
   use plydyn_model_control, only : linear_strain, total_lagrangian
   use plydyn_law_metal_kinematic, only : kinematic_constants_type
   use plydyn_model_material, only : material_type
   use plydyn_model_model, only : model_type
   use plydyn_parallel_thread_team, only : thread_team_type, new_thread_team
   use plydyn_method_forces, only : find_internal_forces
   use sample, only : rectangle_mesh, rectangle_model
   use testing, only : begin, check, finish
   use groups, only : plate_of
   use plydyn_element_plate_layers, only : plate_type
   implicit none

   !> Size of the plate, and thickness of a ply
   real(wp), parameter :: length = 6.0_wp, width = 4.0_wp, thickness = 0.25_wp
   !> Two metals (the paper's table 3) around an elastic ply: Young's modulus and yield stress
   integer, parameter :: metals(2) = [1, 3]
   real(wp), parameter :: young(2) = [210.0e3_wp, 70.0e3_wp], yield(2) = [210.0_wp, 110.0_wp]
   real(wp), parameter :: poisson = 0.3_wp
   integer :: side

   do side = 2, 3
      call test_uniaxial_strain(side, [1, 1, 1])
      call test_uniaxial_strain(side, [2, 1, 3])
      call test_elastic_range(side)
      call test_stored(side, linear_strain)
      call test_stored(side, total_lagrangian)
   end do
   call finish()

contains

   !> Beyond yield, sxx - syy is the yield stress and the mean stress is K times the strain
   subroutine test_uniaxial_strain(side, orders)
      integer, intent(in) :: side, orders(3)

      real(wp), parameter :: most = 0.01_wp
      integer, parameter :: steps = 7
      type(domain_type) :: domain
      real(wp), allocatable :: history(:)
      real(wp) :: alpha(2), bulk, dissipated, shear
      integer :: i

      call begin("uniaxial strain")
      call make(side, orders, linear_strain, domain)
      allocate (history(domain%histories))
      history(:) = 0.0_wp
      do i = 1, steps
         call strain_plate(domain, most*real(i, wp)/real(steps, wp), history)
      end do
      dissipated = 0.0_wp
      do i = 1, 2
         bulk = young(i)/(3.0_wp*(1.0_wp - 2.0_wp*poisson))
         shear = young(i)/(2.0_wp*(1.0_wp + poisson))
         ! 2 G (most - 3/2 alpha) is the yield stress
         alpha(i) = (most - 0.5_wp*yield(i)/shear)/1.5_wp
         call check_layer(domain, metals(i), most, history, bulk*most + yield(i)/1.5_wp, &
            & bulk*most - yield(i)/3.0_wp, alpha(i))
         dissipated = dissipated + yield(i)*alpha(i)*length*width*thickness
      end do
      call check(alpha(1), 5.8e-3_wp, 1.0e-12_wp, "plastic strain of the first metal by hand")
      call check(metal_energy(domain, history), dissipated, 1.0e-10_wp*dissipated, &
         & "the energy dissipated is yield stress times plastic strain times volume")
      call check_elastic_layer(domain, most, history)

      ! back by less than twice the strain at yield
      call strain_plate(domain, most - 1.0e-3_wp, history)
      call check(metal_energy(domain, history), dissipated, 1.0e-10_wp*dissipated, &
         & "unloading dissipates nothing")
   end subroutine test_uniaxial_strain

   !> Below yield nothing is dissipated
   subroutine test_elastic_range(side)
      integer, intent(in) :: side

      type(domain_type) :: domain
      real(wp), allocatable :: history(:)

      call begin("elastic range")
      call make(side, [1, 2, 1], total_lagrangian, domain)
      allocate (history(domain%histories))
      history(:) = 0.0_wp
      call strain_plate(domain, 1.0e-3_wp, history)
      call check(metal_energy(domain, history), 0.0_wp, 0.0_wp, "nothing is dissipated")
      call check(maxval(abs(history)), 0.0_wp, 0.0_wp, "and nothing is remembered")
   end subroutine test_elastic_range

   !> The energy stored falls by the work of the forces on the points
   subroutine test_stored(side, kinematics)
      integer, intent(in) :: side, kinematics

      real(wp), parameter :: tiny_step = 1.0e-3_wp
      type(domain_type) :: domain
      real(wp), allocatable :: history(:), force(:), u(:), v(:)
      real(wp) :: fall

      call begin("stored energy")
      call make(side, [2, 1, 3], kinematics, domain)
      allocate (history(domain%histories))
      history(:) = 0.0_wp
      u = wavy(domain, 1.0e-4_wp, 1.0_wp)
      v = wavy(domain, 1.0e-4_wp, 2.0_wp)
      allocate (force(size(u)))
      force(:) = 0.0_wp
      call add_forces(domain, u, history, force)
      fall = (energy_at(domain, u - tiny_step*v) - energy_at(domain, u + tiny_step*v)) &
         & /(2.0_wp*tiny_step)
      call check(dot_product(force, v)/fall, 1.0_wp, 1.0e-6_wp, "falls by the work of the forces")
   end subroutine test_stored

   !> Energy stored before anything yields
   real(wp) function energy_at(domain, displacement)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in), contiguous :: displacement(:)

      real(wp) :: energy(3), history(domain%histories)

      history(:) = 0.0_wp
      energy(:) = stored_energies(domain, displacement, history)
      energy_at = energy(1)
   end function energy_at

   !> A displacement that varies in all directions
   function wavy(domain, amplitude, frequency) result(displacement)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: amplitude, frequency
      real(wp), allocatable :: displacement(:)

      integer :: i, k, n, t

      allocate (displacement(domain%columns%freedoms))
      displacement(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do k = 1, size(domain%layers%order)
            do t = 1, domain%layers%order(k) + 1
               do i = 1, 3
                  displacement(domain%columns%freedom(k, t, i, n)) = amplitude*sin(frequency &
                     & *(domain%position(1, n) + i*domain%position(2, n) &
                     & + 5.0_wp*domain%layers%height(k, t)) + i)
               end do
            end do
         end do
      end do
   end function wavy

   !> What metals have dissipated, where nothing else does
   real(wp) function metal_energy(domain, history)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in), contiguous :: history(:)

      real(wp) :: energy(mechanisms)

      energy(:) = dissipated_energies(domain, history, [delamination_type ::])
      metal_energy = energy(by_metal_plasticity)
      call check(abs(sum(energy) - metal_energy), 0.0_wp, 0.0_wp, "nothing else dissipates")
   end function metal_energy

   !> Stress and plastic strain of a layer, the same at all its Gauss points
   subroutine check_layer(domain, layer, strain, history, along, across, alpha)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: layer
      real(wp), intent(in) :: strain, history(:), along, across, alpha

      real(wp), allocatable :: values(:, :)

      values = at_points(domain, layer, strain, history)
      call check(maxval(abs(values(stress_at + 1, :) - along)) < 1.0e-9_wp*along, "stress along")
      call check(maxval(abs(values(stress_at + 2:stress_at + 3, :) - across)) < 1.0e-9_wp*along, &
         & "stress across")
      call check(maxval(abs(values(stress_at + 4:stress_at + 6, :))) < 1.0e-9_wp*along, "no shear")
      call check(maxval(abs(values(scalars_at + shows_plastic_strain, :) - alpha)) < 1.0e-12_wp, &
         & "plastic strain")
   end subroutine check_layer

   !> The elastic ply between the metals stays elastic
   subroutine check_elastic_layer(domain, strain, history)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: strain, history(:)

      real(wp), allocatable :: once(:, :), half(:, :)

      once = at_points(domain, 2, strain, history)
      half = at_points(domain, 2, 0.5_wp*strain, history)
      call check(maxval(abs(once(stress_at + 1:stress_at + 6, :) &
         & - 2.0_wp*half(stress_at + 1:stress_at + 6, :))) < 1.0e-9_wp*maxval(once), &
         & "stress is linear in strain")
      call check(maxval(abs(once(scalars_at + shows_plastic_strain, :))), 0.0_wp, 0.0_wp, &
         & "no plastic strain")
   end subroutine check_elastic_layer

   !> Recovered values at all Gauss points of a layer of the second quad
   function at_points(domain, layer, strain, history) result(values)
      type(domain_type), intent(in) :: domain
      integer, intent(in) :: layer
      real(wp), intent(in) :: strain, history(:)
      real(wp), allocatable :: values(:, :)
      type(plate_type) :: plate

      plate = plate_of(domain, 1)
      associate (slot => domain%columns%layer_slot(:, layer))
         values = reshape(layer_values(plate, slot(1), slot(2), slot(3), 2, .false., &
            & stretched(domain, strain), history), &
            & [recovered, size(plate%node, 1)*(domain%layers%order(layer) + 1)])
      end associate
   end function at_points

   !> Let the histories follow a strain along x
   subroutine strain_plate(domain, strain, history)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: strain
      real(wp), intent(inout), contiguous :: history(:)

      real(wp), allocatable :: force(:)

      allocate (force(domain%columns%freedoms))
      force(:) = 0.0_wp
      call add_forces(domain, stretched(domain, strain), history, force)
   end subroutine strain_plate

   !> Forces of the elements
   subroutine add_forces(domain, displacement, history, force)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in), contiguous :: displacement(:)
      real(wp), intent(inout), contiguous :: history(:), force(:)

      type(thread_team_type) :: team

      call new_thread_team(domain%chunks%order, domain%chunks%outer, team)
      call find_internal_forces(domain, team, 1.0e-6_wp, displacement, 0.0_wp*displacement, &
         & history, force)
   end subroutine add_forces

   !> Displacement of a strain along x
   function stretched(domain, strain) result(displacement)
      type(domain_type), intent(in) :: domain
      real(wp), intent(in) :: strain
      real(wp), allocatable :: displacement(:)

      integer :: k, n, t

      allocate (displacement(domain%columns%freedoms))
      displacement(:) = 0.0_wp
      do n = 1, domain%columns%nodes
         do k = 1, size(domain%layers%order)
            do t = 1, domain%layers%order(k) + 1
               displacement(domain%columns%freedom(k, t, 1, n)) = strain*domain%position(1, n)
            end do
         end do
      end do
   end function stretched

   !> A plate of two metals around an elastic ply, with distorted quads
   subroutine make(side, orders, kinematics, domain)
      integer, intent(in) :: side, orders(3), kinematics
      type(domain_type), intent(out) :: domain

      type(error_type), allocatable :: error
      type(model_type) :: model

      model = rectangle_model(rectangle_mesh(side, 3, 2, length, width, 0.06_wp), &
         & [30.0_wp, 45.0_wp, -60.0_wp], thickness, orders)
      model%materials = [metal(1), model%materials(1), metal(2)]
      model%parts(1)%plies%material = [1, 2, 3]
      model%control%kinematics = kinematics
      call build_domain(model, domain, error)
      call check(.not. allocated(error), "the domain is built")
   end subroutine make

   !> A metal without hardening
   function metal(i) result(material)
      integer, intent(in) :: i
      type(material_type) :: material

      material%id = 10 + i
      material%title = "metal"
      material%density = 7.8e-9_wp
      allocate (material%law, source=kinematic_constants_type(young=spread(young(i), 1, 3), &
         & poisson=spread(poisson, 1, 3), &
         & shear=spread(young(i)/(2.0_wp*(1.0_wp + poisson)), 1, 3), &
         & yield=yield(i)))
   end function metal

end program test_domain_element_energies
