!> Numbers as text, and text without case.
program test_base_text
   use, intrinsic :: ieee_arithmetic, only : ieee_positive_inf, ieee_quiet_nan, ieee_value
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : duration_text, fixed_text, lower_case, number_of, text, upper_case
   use testing, only : begin, check, finish
   implicit none

   call begin("text")
   call check(text(-42) == "-42", "an integer without blanks")
   call check(text(50.0_wp, 2) == "50", "a real without a point at its end: "//text(50.0_wp, 2))
   call check(text(0.25_wp, 2) == "0.25", "digits behind the point stay: "//text(0.25_wp, 2))
   call check(text(12345.6_wp, 3) == "12346", "all digits before the point: "//text(12345.6_wp, 3))
   call check(text(120000.4_wp) == "120000", "their zeros too: "//text(120000.4_wp))
   call check(text(0.25_wp) == "0.25", "no zeros at the end: "//text(0.25_wp))
   call check(text(0.0035_wp) == "0.0035", "a small share without exponent: "//text(0.0035_wp))
   call check(text(-0.0123456_wp) == "-0.0123456", "six digits of it")
   call check(text(9.9999999_wp) == "10", "rounded up: "//text(9.9999999_wp))
   call check(text(-3.0_wp) == "-3", "no point without need")
   call check(text(1.6e-9_wp) == "1.6e-9", "small: "//text(1.6e-9_wp))
   call check(text(2.5e12_wp) == "2.5e12", "large: "//text(2.5e12_wp))
   call check(text(1.0e-9_wp) == "1e-9", "round: "//text(1.0e-9_wp))
   call check(text(1.0e201_wp) == "1e201", "beyond squares: "//text(1.0e201_wp))
   call check(text(ieee_value(1.0_wp, ieee_quiet_nan)) == "NaN", "no number")
   call check(text(ieee_value(1.0_wp, ieee_positive_inf)) == "Inf", "infinity")

   call begin("fixed_text")
   call check(fixed_text(0.04_wp, 1) == "0.0", "a zero before the point: "//fixed_text(0.04_wp, 1))
   call check(fixed_text(-0.5_wp, 2) == "-0.50", "and behind a sign: "//fixed_text(-0.5_wp, 2))
   call check(fixed_text(12.3456_wp, 3) == "12.346", "rounded: "//fixed_text(12.3456_wp, 3))
   call check(fixed_text(40459.2_wp, 0) == "40459", "no point without digits")
   call check(fixed_text(0.2_wp, 0) == "0", "nor before nothing: "//fixed_text(0.2_wp, 0))
   call check(len(fixed_text(1.0e300_wp, 0)), 301, "as long as it takes")

   call begin("duration_text")
   call check(duration_text(0.4_wp) == "0:00:00", "rounds to seconds")
   call check(duration_text(3599.6_wp) == "1:00:00", "carries to hours")
   call check(duration_text(1.0e5_wp) == "27:46:40", "hours go on past a day")
   call check(duration_text(-1.0_wp) == "-", "unknown")
   call check(duration_text(1.0e300_wp) == "-", "beyond a year")

   call begin("number_of")
   call check(number_of(1, "error") == "1 error", "one")
   call check(number_of(0, "error") == "0 errors", "none: "//number_of(0, "error"))
   call check(number_of(2, "error") == "2 errors", "two")

   call begin("lower_case, upper_case")
   call check(lower_case("aB1_Z") == "ab1_z", "small letters")
   call check(upper_case("aB1_z") == "AB1_Z", "capitals")

   call finish()
end program test_base_text
