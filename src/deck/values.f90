!> Reads the number or word of a field and checks it against the declaration.
module plydyn_deck_values
   use plydyn_base_precision, only : wp
   use plydyn_base_text, only : text, upper_case
   use plydyn_deck_declaration, only : field_type, integer_field, real_field, word_field
   use plydyn_deck_nearest, only : nearest_word
   use plydyn_deck_number, only : number_advice, read_integer, read_real
   use plydyn_deck_parameter, only : parameter_table_type
   use plydyn_deck_report, only : fault_type
   implicit none
   private

   public :: read_number, check_word, range_words, split_words

   !> Range of magnitudes that is accepted: products of larger ones would overflow
   real(wp), parameter :: smallest = 1.0e-100_wp, largest = 1.0e100_wp
   !> Digits that tell any two numbers of a deck apart, but for the last of 17
   integer, parameter :: most_digits = 15
   !> Longest word
   integer, parameter, public :: longest_word = 32

contains

   !> Number that a field holds
   subroutine read_number(field, content, parameters, number, fault)
      !> What the field declares
      type(field_type), intent(in) :: field
      !> What the field holds, without blanks around it
      character(*), intent(in) :: content
      !> Parameters defined so far
      type(parameter_table_type), intent(in) :: parameters
      !> The number, without error
      real(wp), intent(out) :: number
      !> What is wrong
      type(fault_type), intent(out) :: fault

      if (content(1:1) == "&" .or. content(1:min(2, len(content))) == "-&") then
         call read_parameter(field, content, parameters, number, fault)
      else
         call read_literal(field, content, number, fault)
      end if
      if (fault%at > 0) return
      if (field%zero_is_default .and. abs(number) <= 0.0_wp) then
         number = field%default
      else if (abs(number) > largest .or. (abs(number) < smallest .and. abs(number) > 0.0_wp)) then
         call fault%set(1, trim(field%name)//" cannot be "//whole_text(number), &
            & range_words(field)//"; all numbers but 0 lie between "//text(smallest) &
            & //" and "//text(largest))
      else
         call check_range(field, number, fault)
      end if
   end subroutine read_number

   !> Number of a parameter
   subroutine read_parameter(field, content, parameters, number, fault)
      type(field_type), intent(in) :: field
      !> &name or -&name
      character(*), intent(in) :: content
      type(parameter_table_type), intent(in) :: parameters
      !> Its number
      real(wp), intent(out) :: number
      type(fault_type), intent(out) :: fault

      integer :: begin, i

      number = 0.0_wp
      begin = index(content, "&") + 1
      i = parameters%find(content(begin:))
      if (i == 0) then
         call fault%set(begin, "there is no parameter '"//content(begin:)//"' above this line", &
            & parameters%advice(content(begin:)))
         return
      end if
      if (parameters%list(i)%is_wrong) then
         call fault%set(begin, "", "")
         return
      end if
      number = parameters%list(i)%value
      if (content(1:1) == "-") number = -number
      if (field%kind == integer_field .and. abs(number - anint(number)) > 0.0_wp) then
         call fault%set(1, "the parameter '"//content(begin:)//"' is " &
            & //text(number)//", but "//trim(field%name)//" is an integer", range_words(field))
      end if
   end subroutine read_parameter

   !> Number written in the field
   subroutine read_literal(field, content, number, fault)
      type(field_type), intent(in) :: field
      !> Digits
      character(*), intent(in) :: content
      real(wp), intent(out) :: number
      type(fault_type), intent(out) :: fault

      character(:), allocatable :: advice
      integer :: real_wrong_at, whole, wrong_at

      if (field%kind == integer_field) then
         call read_integer(content, whole, wrong_at)
         number = real(whole, wp)
         if (wrong_at == 0) return
         call read_real(content, number, real_wrong_at)
         ! LS-DYNA's users and writers give integers a point where its own field is real
         if (real_wrong_at == 0 .and. abs(number) <= real(huge(1), wp) &
            & .and. abs(number - anint(number)) <= 0.0_wp) then
            if (abs(number) <= 0.0_wp) call refuse_powers(field, content, fault)
            return
         end if
         if (real_wrong_at == 0 .and. wrong_at > 1) then
            call fault%set(wrong_at, "'"//content//"' is not an integer", &
               & range_words(field)//", without a fraction")
            return
         end if
      else
         call read_real(content, number, wrong_at)
         if (wrong_at == 0 .and. abs(number) <= 0.0_wp) call refuse_powers(field, content, fault)
         if (wrong_at == 0) return
      end if
      advice = number_advice(content, wrong_at)
      if (len(advice) > 0) advice = "; "//advice
      call fault%set(wrong_at, "'"//content//"' is not "//plain_noun(field), &
         & range_words(field)//advice)
   end subroutine read_literal

   !> Refuse a zero with an exponent, as behind a decimal comma: 1,0e-6 would be 1 and 0
   subroutine refuse_powers(field, content, fault)
      type(field_type), intent(in) :: field
      !> A zero
      character(*), intent(in) :: content
      type(fault_type), intent(inout) :: fault

      integer :: letter

      letter = scan(content, "eEdD")
      if (letter == 0) return
      if (verify(content(letter + 1:), "+-0") == 0) return
      call fault%set(1, "'"//content//"' is a zero with an exponent", range_words(field) &
         & //"; a number has a decimal point, not a comma: 1."//content//", not 1,"//content)
   end subroutine refuse_powers

   !> Report a number that the field does not accept
   subroutine check_range(field, number, fault)
      type(field_type), intent(in) :: field
      real(wp), intent(in) :: number
      type(fault_type), intent(out) :: fault

      logical :: fits

      if (allocated(field%allowed)) then
         fits = any(abs(field%allowed - number) <= 0.0_wp)
      else
         fits = number >= field%least .and. number <= field%most .and. number > field%above
      end if
      if (fits) return
      if (field%supported) then
         call fault%set(1, trim(field%name)//" cannot be "//whole_text(number), range_words(field))
      else if (allocated(field%successor)) then
         call fault%set(1, trim(field%name)//" = "//whole_text(number) &
            & //" is an option that was removed", "a blank or 0: "//field%successor)
      else
         call fault%set(1, trim(field%name)//" = "//whole_text(number)//" is not supported", &
            & "a blank or "//range_words(field)//": plydyn does not use "//trim(field%name))
      end if
   end subroutine check_range

   !> Text of a number with all of its digits, so that one beside a limit does not look like it
   pure function whole_text(number) result(string)
      real(wp), intent(in) :: number
      character(:), allocatable :: string
      real(wp) :: shown

      string = text(number)
      read (string, *) shown
      if (abs(shown - number) > 0.0_wp) string = text(number, most_digits)
   end function whole_text

   !> Report a word that the field does not accept
   subroutine check_word(field, content, fault)
      !> What the field declares
      type(field_type), intent(in) :: field
      !> What the field holds
      character(*), intent(in) :: content
      !> What is wrong
      type(fault_type), intent(out) :: fault

      character(longest_word), allocatable :: known(:)
      integer :: i

      if (len(field%words) == 0) return
      known = split_words(field%words)
      if (any(known == upper_case(content))) return
      i = nearest_word(upper_case(content), known)
      if (i > 0) then
         call fault%set(1, "'"//content//"' is not a value of "//trim(field%name), &
            & "perhaps "//trim(known(i))//"; it is one of "//field%words)
      else
         call fault%set(1, "'"//content//"' is not a value of "//trim(field%name), &
            & "one of "//field%words)
      end if
   end subroutine check_word

   !> Values that a field accepts, in words
   function range_words(field) result(words)
      !> What the field declares
      type(field_type), intent(in) :: field
      character(:), allocatable :: words

      integer :: i

      if (allocated(field%allowed)) then
         words = text(field%allowed(1))
         do i = 2, size(field%allowed)
            if (i < size(field%allowed)) words = words//", "//text(field%allowed(i))
            if (i == size(field%allowed)) words = words//" or "//text(field%allowed(i))
         end do
         return
      end if
      if (field%kind == word_field) then
         words = "one of "//field%words
         return
      end if
      if (.not. field%least < field%most) then
         words = text(field%most)
         return
      end if
      words = plain_noun(field)
      if (field%kind == real_field) words = words//" ("//field%dimension//")"
      if (field%above > -huge(1.0_wp)) words = words//" above "//text(field%above)
      if (field%least > -huge(1.0_wp) .and. field%most < huge(1.0_wp)) then
         words = words//" from "//text(field%least)//" to "//text(field%most)
      else if (field%least > -huge(1.0_wp)) then
         words = words//" of at least "//text(field%least)
      else if (field%most < huge(1.0_wp)) then
         words = words//merge(" up to    ", " of up to ", field%above > -huge(1.0_wp))
         words = trim(words)//" "//text(field%most)
      end if
   end function range_words

   !> Kind of number without its dimension
   pure function plain_noun(field) result(words)
      type(field_type), intent(in) :: field
      character(:), allocatable :: words

      words = "a number"
      if (field%kind == integer_field) words = "an integer"
   end function plain_noun

   !> The words of a text, separated by blanks or commas
   pure function split_words(words) result(list)
      !> Any text
      character(*), intent(in) :: words
      character(longest_word), allocatable :: list(:)

      integer :: begin, count, last, pass

      do pass = 1, 2
         count = 0
         last = 0
         do
            begin = verify(words(last + 1:), " ,")
            if (begin == 0) exit
            begin = last + begin
            last = begin + scan(words(begin:)//" ", " ,") - 2
            count = count + 1
            if (pass == 2) list(count) = words(begin:last)
         end do
         if (pass == 1) allocate (list(count))
      end do
   end function split_words

end module plydyn_deck_values
