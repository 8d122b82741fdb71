# The plate kernels: one source for each number of plane nodes and each order of expansion, all
# expanded from the one template, so that every loop bound is known to the compiler.
set(kernel_sources)
foreach(side 2 3)
  math(EXPR nodes "${side} * ${side}")
  foreach(order 1 2 3 4)
    set(kernel ${CMAKE_CURRENT_BINARY_DIR}/element/plate_q${nodes}_le${order}.f90)
    configure_file(${CMAKE_CURRENT_SOURCE_DIR}/element/plate_kernel.f90.in ${kernel} @ONLY)
    list(APPEND kernel_sources ${kernel})
  endforeach()
endforeach()
set_property(SOURCE ${kernel_sources} APPEND PROPERTY COMPILE_OPTIONS
  $<$<CONFIG:Release>:-mprefer-vector-width=512;--param=max-completely-peeled-insns=1000>)
