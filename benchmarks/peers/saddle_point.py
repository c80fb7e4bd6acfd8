"""Linear systems of the midpoint rule on meshes whose factors take too long, by PETSc's preconditioners for saddle points.

  [A Bᵀ; C 0] with A = 2ρM/h² + ∂²W: flexible GMRES with [A Bᵀ; 0 −S]. A is inverted to 0.1 by conjugate gradients with its
  diagonal, S = C diag(A)⁻¹ Bᵀ by a cycle of BoomerAMG.

The systems are solved to 1e-2, because the iterations around them are modified Newton iterations. In the release by FEniCSx on
26,035 unknowns, a system then takes 2.8 iterations on average. Full block factors, A to 0.01 and systems to 1e-4 took up to four times
as long there. ILU for S took as long as BoomerAMG on up to 59,075 unknowns.
"""
import numpy as np
from petsc4py import PETSc

OPTIONS = {
    "ksp_type": "fgmres", "ksp_rtol": 1e-2, "pc_type": "fieldsplit", "pc_fieldsplit_type": "schur",
    "pc_fieldsplit_schur_fact_type": "upper", "pc_fieldsplit_schur_precondition": "selfp",
    "fieldsplit_u_ksp_type": "cg", "fieldsplit_u_ksp_rtol": 0.1, "fieldsplit_u_pc_type": "jacobi",
    "fieldsplit_p_ksp_type": "preonly", "fieldsplit_p_pc_type": "hypre", "fieldsplit_p_pc_hypre_type": "boomeramg",
}


def solver(matrix, is_displacement, comm=PETSc.COMM_SELF):
    """The function that solves with a PETSc matrix; the matrix stays the caller's. Vectors are those of this rank."""
    ksp, options = PETSc.KSP().create(comm), PETSc.Options()
    ksp.setOperators(matrix)
    for name, value in OPTIONS.items():
        options[name] = value
    ksp.getPC().setType("fieldsplit")
    first = matrix.getOwnershipRange()[0]
    ksp.getPC().setFieldSplitIS(*((name, PETSc.IS().createGeneral((first + np.flatnonzero(chosen)).astype(np.int32), comm))
                                  for name, chosen in (("u", is_displacement), ("p", ~is_displacement))))
    ksp.setFromOptions()
    ksp.setUp()
    b, x = matrix.createVecs()

    def solve(residual):
        b.array = residual
        ksp.solve(b, x)
        if ksp.getConvergedReason() < 0:
            raise SystemExit(f"error: no convergence of a linear system: {ksp.getConvergedReason()}")
        return x.array
    return solve
