! SPDX-License-Identifier: Apache-2.0
! SPDX-FileCopyrightText: Treadmark contributors
!
! The module and the include file of the library: a sphere on a plane, and the equation of Hertz.
program fortran_program
   use contact_addon
   use, intrinsic :: iso_c_binding, only: c_double, c_int, c_char
   implicit none
   integer(c_int) :: error, version, mx, my
   real(c_double) :: fn, fx, fy, mz, approach, expected
   real(c_double), allocatable :: pn(:), px(:), py(:)

   error = -1
   version = 0
   call cntc_initialize(1_c_int, 3_c_int, version, error, [c_char_" "], 1_c_int)
   if (error /= 0 .or. version /= 2520) stop 1
   call cntc_setflags(1, 1, 1, [CNTC_ic_tang], [0])
   call cntc_setmaterialparameters(1, 1, 0, 4, [0.28d0, 0.28d0, 82d3, 82d3])
   call cntc_sethertzcontact(1, 1, -1, 5, [33d0, 33d0, 1d-3, 1d-3, 1.1d0])
   call cntc_setnormalforce(1, 1, 1d4)
   call cntc_calculate(1, 1, error)
   if (error /= 0) stop 2
   call cntc_getcontactforces(1, 1, fn, fx, fy, mz)
   call cntc_getpenetration(1, 1, approach)
   call cntc_getnumelements(1, 1, mx, my)
   allocate (pn(mx*my), px(mx*my), py(mx*my))
   call cntc_gettractions(1, 1, mx*my, pn, px, py)
   expected = 2d0*1d-3*(3d0*1d4*0.72d0/(8d0*1d-3*82d3))**(2d0/3d0)   ! a^2 / R
   print '(a,f10.2,a,f10.6,a,f10.6)', ' F_n ', fn, ' N, approach ', approach, ' mm, expected ', expected
   if (abs(fn - 1d4) > 1d0 .or. abs(approach - expected) > 0.01d0*expected .or. mx /= 33 .or. maxval(pn) <= 0d0) stop 3
   call check_constants()
   call cntc_finalize(1)

contains

   subroutine check_constants()
      integer :: from_module
      from_module = CNTC_FLAGS_DIM
      block
         include 'caddon_flags.inc'
         if (CNTC_FLAGS_DIM /= from_module .or. CNTC_if_units /= 1933) stop 4
      end block
   end subroutine

end program fortran_program
