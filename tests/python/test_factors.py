"""Form factors against closed forms and laws."""

import math

import numpy as np
import pytest
from conftest import cube_mesh, room_with_box
from scipy.sparse.linalg import gmres

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")


def opposed_squares(distance):
    """Howell, C-11: two unit squares."""
    x = 1 / distance
    f = math.log(math.sqrt((1 + x * x) ** 2 / (1 + 2 * x * x)))
    f += 2 * x * math.sqrt(1 + x * x) * math.atan(x / math.sqrt(1 + x * x)) - 2 * x * math.atan(x)
    return 2 / (math.pi * x * x) * f


def plates(distance):
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    other = square[[0, 3, 2, 1]] + [0, 0, distance]
    return rad.Mesh(np.concatenate([square, other]), [[0, 1, 2, 3], [4, 5, 6, 7]])


@pytest.mark.parametrize("distance", [0.1, 1, 7])
def test_opposed_squares_have_the_closed_form(distance):
    F = rad.form_factors(plates(distance))
    assert F.matrix[0, 1] == pytest.approx(opposed_squares(distance), rel=1e-9)
    assert F.matrix[1, 0] == pytest.approx(opposed_squares(distance), rel=1e-9)
    assert F.error.nnz == F.matrix.nnz
    assert not F.error.toarray().any()


def test_the_walls_of_a_cube_see_all_of_each_other(cube):
    F = rad.form_factors(cube)
    assert F.by_surface() == pytest.approx(F.matrix.toarray())
    opposite = opposed_squares(1)
    assert F.matrix.toarray() == pytest.approx(
        np.kron(np.eye(3), [[0, opposite], [opposite, 0]])
        + np.kron(1 - np.eye(3), np.full((2, 2), (1 - opposite) / 4)),
        rel=1e-9,
    )
    assert F.row_sums == pytest.approx(1, abs=1e-12)
    assert F.report["closed"]


def test_partly_hidden_pairs_are_reciprocal_and_have_errors():
    F = rad.form_factors(room_with_box(), tolerance=1e-2)
    exchange = F.matrix.toarray() * F.area[:, None]
    assert np.abs(exchange - exchange.T).max() < 1e-15
    assert (F.error.data > 0).any()
    assert F.row_sums == pytest.approx(1, abs=1e-9)
    fine = rad.form_factors(room_with_box(), tolerance=1e-4)
    off = np.abs(F.matrix.toarray() - fine.matrix.toarray())
    allowed = np.hypot(F.error.toarray(), fine.error.toarray())
    assert (off <= 4 * allowed + 1e-6).mean() > 0.99
    assert F.by_surface_error().shape == (7, 7)


def test_rows_products_and_the_matrix_are_the_same_operator():
    F = rad.form_factors(room_with_box(4))
    n = F.shape[0]
    rng = np.random.default_rng(5)
    B = rng.random((n, 3))
    assert F @ B == pytest.approx(F.matrix @ B, abs=1e-12)
    assert F @ B[:, 0] == pytest.approx((F @ B)[:, 0], abs=1e-15)
    assert F.T @ B == pytest.approx(F.matrix.T @ B, abs=1e-12)
    assert F.row(3) == pytest.approx(F.matrix[3].toarray()[0], abs=1e-15)
    assert (F.row(-1) == F.row(n - 1)).all()
    assert F.row_error(3) == pytest.approx(F.error[3].toarray()[0])
    errors = np.sqrt(F.error.power(2) @ (B**2))
    assert F.apply_error(B) == pytest.approx(errors, rel=1e-6, abs=1e-15)


def test_results_do_not_depend_on_threads():
    one = rad.form_factors(room_with_box(5), threads=1).matrix
    three = rad.form_factors(room_with_box(5), threads=3).matrix
    assert (one != three).nnz == 0


def test_faces_are_divided_when_asked(cube):
    F = rad.form_factors(cube, patches=600)
    assert 400 < len(F.patches) < 900
    assert set(F.patches.face) == set(range(6))
    assert F.area.sum() == pytest.approx(6)
    assert F.by_surface()[0, 1] == pytest.approx(opposed_squares(1), rel=1e-6)
    assert len(rad.form_factors(cube, max_edge=0.25).patches) == 96


def test_two_sided_faces_have_a_patch_on_each_side():
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    F = rad.form_factors(rad.Mesh(square, [[0, 1, 2, 3]], two_sided=True))
    assert F.shape == (2, 2)
    assert F.patches.twin.tolist() == [1, 0]
    assert F.patches.normal[0] == pytest.approx(-F.patches.normal[1])


def test_transport_may_be_compressed():
    mesh = room_with_box(16)
    T = rad.transport(mesh, kind="compressed", tolerance=1e-2)
    assert not T.is_dense
    verified = T.report["compression"]["verified_error"]
    assert 0 < verified <= 1e-2
    F = rad.transport(mesh, kind="dense", tolerance=1e-3)
    assert isinstance(F, rad.FormFactors)
    B = 1 + T.patches.centroid[:, 0]
    off = np.sqrt((T.area * (T @ B - F @ B) ** 2).sum() / (T.area * (F @ B) ** 2).sum())
    assert off <= verified


def test_scipy_solves_with_the_operator():
    F = rad.form_factors(room_with_box(4))
    n = F.shape[0]
    from scipy.sparse.linalg import LinearOperator

    E = np.zeros(n)
    E[:16] = 1
    system = LinearOperator((n, n), matvec=lambda b: b - 0.5 * (F @ b), dtype=float)
    B, state = gmres(system, E, atol=1e-12)
    assert state == 0
    assert B == pytest.approx(rad.solve(F, E, 0.5).radiosity, rel=1e-4)


def test_points_see_surfaces(cube):
    F = rad.factors_from_points(cube, [[0.5, 0.5, 0.5]] * 2, [[0, 0, 2], [1, 0, 0]])
    assert F.shape == (2, 6)
    assert F.sum(axis=1) == pytest.approx(1)
    # Half a unit above the middle of a unit square, Howell B-4 four times.
    above = 4 / (2 * math.pi) * 2 * (1 / math.sqrt(2)) * math.atan(1 / math.sqrt(2))
    assert F[0, cube.names.index("z1")] == pytest.approx(above)
    one, backs, sky = rad.factors_from_points(plates(1), [0.5, 0.5, 0], [0, 0, 1], rest=True)
    assert one[0].sum() + backs[0] + sky[0] == pytest.approx(1)
    assert backs[0] == 0


def test_form_factors_are_saved_and_loaded(tmp_path):
    F = rad.form_factors(room_with_box(4))
    F.save(tmp_path / "F.h5")
    again = rad.load(tmp_path / "F.h5")
    assert isinstance(again, rad.FormFactors)
    # The file has F, of which A_i F_ij is taken again.
    assert again.matrix.data == pytest.approx(F.matrix.data, rel=1e-15)
    T = rad.transport(cube_mesh(12), kind="compressed")
    T.save(tmp_path / "T.h5")
    B = np.arange(T.shape[0], dtype=float)
    assert (rad.load(tmp_path / "T.h5") @ B == T @ B).all()


def test_coordinates_of_single_precision_are_taken_as_such():
    rotation = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    exact = room_with_box(4)
    turned = exact.vertices @ rotation
    single = rad.Mesh(turned.astype(np.float32), exact.faces, surface=exact.surface)
    F = rad.form_factors(single)
    assert F.by_surface() == pytest.approx(rad.form_factors(exact).by_surface(), abs=2e-4)
