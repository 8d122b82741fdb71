!> Memory that a run takes, counted from the arrays that grow with the mesh.
module plydyn_domain_memory
   use plydyn_base_precision, only : wp
   use plydyn_fem_columns, only : alignment_offset
   use plydyn_domain_domain, only : domain_type
   use plydyn_model_model, only : model_type
   implicit none
   private

   public :: any_history, history_bytes, intact_bytes, least_bytes, mesh_bytes, motion_bytes

   !> Bytes of a real and of an integer
   real(wp), parameter :: real_bytes = storage_size(1.0_wp)/8, integer_bytes = storage_size(1)/8
   !> Arrays of motion: displacement and velocity; accelerations have the columns behind, too
   integer, parameter :: motions = 2
   !> Numbers of a freedom that no model does without: its motion and its mass
   real(wp), parameter :: least_reals = 4.0_wp

contains

   !> Motion, masses, geometry of elements, averages, chunks, supports, loads and faces
   pure real(wp) function mesh_bytes(domain) result(bytes)
      type(domain_type), intent(in) :: domain

      real(wp) :: integers, reals
      integer :: i

      associate (columns => domain%columns)
         reals = real(motions*columns%freedoms, wp) + columns%forces &
            & + size(domain%inertia%mass) + size(domain%inertia%inverse_mass) &
            & + size(domain%position)
      end associate
      integers = real(size(domain%node_id) + size(domain%chunks%shared_nodes), wp) &
         & + size(domain%supports%held) + size(domain%supports%support) &
         & + size(domain%inertia%far_ties)
      do i = 1, size(domain%groups)
         reals = reals + domain%groups(i)%item%memory(1)
         integers = integers + domain%groups(i)%item%memory(2)
      end do
      do i = 1, size(domain%averaging%averages)
         associate (average => domain%averaging%averages(i))
            reals = reals + size(average%weight)
            integers = integers + size(average%first) + size(average%row)
         end associate
      end do
      do i = 1, size(domain%chunks%list)
         integers = integers + size(domain%chunks%list(i)%column)
      end do
      do i = 1, size(domain%loads)
         reals = reals + size(domain%loads(i)%force)
         integers = integers + size(domain%loads(i)%freedom)
      end do
      do i = 1, size(domain%contact%surfaces)
         associate (face => domain%contact%surfaces(i))
            reals = reals + size(face%position) + size(face%inverse_mass)
            integers = integers + size(face%freedom) + size(face%facet) + size(face%motion)
         end associate
      end do
      bytes = real_bytes*reals + integer_bytes*integers
   end function mesh_bytes

   !> Displacement, velocity and acceleration, as in restart files
   pure real(wp) function motion_bytes(domain) result(bytes)
      type(domain_type), intent(in) :: domain

      bytes = real_bytes*(real(motions, wp)*domain%columns%freedoms + domain%columns%forces)
   end function motion_bytes

   !> Less than a model takes on all ranks together, known before anything is built of it
   pure real(wp) function least_bytes(model) result(bytes)
      type(model_type), intent(in) :: model

      real(wp) :: points

      associate (plies => model%parts(1)%plies)
         points = size(model%mesh%node_id)*sum(real(plies%layers, wp)*real(plies%order + 1, wp))
      end associate
      bytes = 3.0_wp*least_reals*real_bytes*points
   end function least_bytes

   !> Whether any Gauss point has a history
   pure logical function any_history(domain)
      type(domain_type), intent(in) :: domain

      any_history = domain%histories > alignment_offset
   end function any_history

   !> Histories of all Gauss points, and received strains of other ranks
   pure real(wp) function history_bytes(domain) result(bytes)
      type(domain_type), intent(in) :: domain

      bytes = real_bytes*real(domain%histories + domain%averaging%halo_strains, wp)
   end function history_bytes

   !> Histories that take memory while all Gauss points are intact, see `clear_pages`
   pure real(wp) function intact_bytes(domain) result(bytes)
      type(domain_type), intent(in) :: domain

      integer, allocatable :: places(:, :)

      places = domain%intact_histories()
      bytes = real_bytes*real(sum(places(2, :) - places(1, :) + 1), wp)
   end function intact_bytes

end module plydyn_domain_memory
