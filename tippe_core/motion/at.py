"""The components of a state y of dynamics.py. While a slip decays, z has the logarithm of its speed and its direction
in place of v_x and v_y; while a patch creeps, its direction n and size sigma in place of v_x, v_y, L_z and v_z."""

PX, PY, PZ, PW, CHI, LX, LY, LZ, VX, VY, X, Y, TIME, HEAT, VZ, Z = range(16)
LOG_U, BETA = VX, VY
NX, NY, NZ, SIGMA = VX, VY, LZ, VZ
