# The plate kernels: one module for each number of plane nodes and each order of expansion, all
# expanded from the same pieces in kernel/, so that every loop bound is known to the compiler. The
# interpolation of interfaces takes lines of three nodes from there, too.
foreach(piece thickness plane_q4 line_q9 plane_q9 linear large law volume)
  file(READ ${CMAKE_CURRENT_SOURCE_DIR}/element/kernel/${piece}.f90.in ${piece})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_SOURCE_DIR}/element/kernel/${piece}.f90.in)
endforeach()
set(kernel_sources)
foreach(side 2 3)
  math(EXPR nodes "${side} * ${side}")
  set(in_plane "${plane_q${nodes}}")
  if(side EQUAL 3)
    string(APPEND in_plane "\n${line_q9}")
  endif()
  foreach(order 1 2 3 4)
    set(kernel ${CMAKE_CURRENT_BINARY_DIR}/element/plate_q${nodes}_le${order}.f90)
    configure_file(${CMAKE_CURRENT_SOURCE_DIR}/element/kernel/module.f90.in ${kernel} @ONLY)
    list(APPEND kernel_sources ${kernel})
  endforeach()
endforeach()
set(points ${CMAKE_CURRENT_BINARY_DIR}/element/interface_points.f90)
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/element/kernel/points.f90.in ${points} @ONLY)
list(APPEND kernel_sources ${points})
set(interface_kernels ${CMAKE_CURRENT_SOURCE_DIR}/element/interface/kernel.f90
  ${CMAKE_CURRENT_SOURCE_DIR}/element/interface/axes.f90
  ${CMAKE_CURRENT_SOURCE_DIR}/element/interface/faces.f90
  ${CMAKE_CURRENT_SOURCE_DIR}/element/interface/rotation.f90
  ${CMAKE_CURRENT_SOURCE_DIR}/element/cracked/stresses.f90
  ${CMAKE_CURRENT_SOURCE_DIR}/element/cracked/wedges.f90)
set_property(SOURCE ${kernel_sources} ${interface_kernels} APPEND PROPERTY COMPILE_OPTIONS
  $<$<CONFIG:Release>:-mprefer-vector-width=512;--param=max-completely-peeled-insns=1000>)
