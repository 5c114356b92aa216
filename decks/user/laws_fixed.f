C     SPDX-License-Identifier: BSD-3-Clause
C     User routines in old fixed-form Fortran, without bind(C).
C     gfortran -O2 -shared -fPIC laws_fixed.f -o liblaws_fixed.so
C
C     Friction: mu_k + (mu_s - mu_k) exp(-(v/v_s)**2), P = mu_s mu_k v_s
      SUBROUTINE STRIBK(IVERS, KIND, X, P, NP, Y, ISTAT)
      INTEGER IVERS, KIND, NP, ISTAT
      DOUBLE PRECISION X(*), P(*), Y(*), S, E
      IF (KIND .NE. 4) THEN
        ISTAT = -1
        RETURN
      END IF
      IF (NP .NE. 3) THEN
        ISTAT = -2
        RETURN
      END IF
      S = X(1)/P(3)
      E = (P(1) - P(2))*EXP(-S*S)
      Y(1) = P(2) + E
      Y(2) = -2D0*S*E/P(3)
      Y(3) = 0D0
      END
C
C     Function of time: P(1) sin**2(P(2) t), a drive
      SUBROUTINE SWING(IVERS, KIND, X, P, NP, Y, ISTAT)
      INTEGER IVERS, KIND, NP, ISTAT
      DOUBLE PRECISION X(*), P(*), Y(*), A, W, Z
      IF (KIND .NE. 1) THEN
        ISTAT = -1
        RETURN
      END IF
      A = P(1)
      W = P(2)
      Z = 2D0*W*X(1)
      Y(1) = A*SIN(W*X(1))**2
      Y(2) = A*W*SIN(Z)
      Y(3) = 2D0*A*W**2*COS(Z)
      Y(4) = -4D0*A*W**3*SIN(Z)
      END
