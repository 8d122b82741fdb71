!> An observer that writes results of a job.
module plydyn_io_output
   use plydyn_base_error, only : error_type
   use plydyn_io_job, only : job_type
   use plydyn_method_observer, only : observer_type
   use plydyn_method_simulation, only : simulation_type
   implicit none
   private

   !> Results of a job
   type, abstract, public, extends(observer_type) :: output_type
   contains
      procedure(open_output), deferred :: open
   end type output_type

   abstract interface
      !> Create the files, or go on with those of an earlier run. Nothing is opened where the deck
      !> asks for no such results. All ranks come here
      subroutine open_output(self, job, simulation, error)
         import :: error_type, job_type, output_type, simulation_type
         implicit none
         class(output_type), intent(inout) :: self
         !> The job, the same on all ranks
         type(job_type), intent(in) :: job
         class(simulation_type), intent(in) :: simulation
         !> Why a file could not be created; the same on all ranks
         type(error_type), allocatable, intent(out) :: error
      end subroutine open_output
   end interface

end module plydyn_io_output
